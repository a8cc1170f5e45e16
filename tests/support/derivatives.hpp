// SPDX-License-Identifier: MIT
/// Derivatives of a trajectory by central differences, to hold the analytic ones against.
#pragma once

#include <array>
#include <cstddef>
#include <splinertia/motion/motion.hpp>
#include <utility>
#include <vector>

namespace splinertia::testing {

/// f'(t) of a vector function from six values around t; error O(h⁶).
template <typename Vector>
Vector central_difference(const auto& f, double t, double h) {
  return (45 * (f(t + h) - f(t - h)) - 9 * (f(t + 2 * h) - f(t - 2 * h)) + (f(t + 3 * h) - f(t - 3 * h))) / (60 * h);
}

/// The largest difference between each analytic derivative of the curve at t and the central difference of the one
/// below it: index 0 for the velocity, 1 for the acceleration, 2 for the jerk.
template <int D, typename Curve>
std::array<double, D> derivative_errors(const Curve& curve, double t, double h) {
  using G = typename Curve::Group;
  const auto m = curve.template evaluate<D>(t);
  std::array<double, D> errors{};
  const auto compare = [&](const Tangent<G>& analytic, const auto& f) {
    return static_cast<double>((analytic - central_difference<Tangent<G>>(f, t, h)).template lpNorm<Eigen::Infinity>());
  };
  if constexpr (D >= 1) {
    errors[0] =
        compare(m.velocity, [&](double s) { return increment<G>(m.value, curve.template evaluate<0>(s).value); });
  }
  if constexpr (D >= 2) {
    errors[1] = compare(m.acceleration, [&](double s) { return curve.template evaluate<1>(s).velocity; });
  }
  if constexpr (D >= 3) {
    errors[2] = compare(m.jerk, [&](double s) { return curve.template evaluate<2>(s).acceleration; });
  }
  return errors;
}

/// f() with points[i] moved by −h and by +h along one direction of its tangent space. The points are unchanged after it.
template <typename G>
auto both_sides(std::vector<G>& points, std::size_t i, Eigen::Index direction, const ScalarOf<G>& h, const auto& f) {
  const G kept = points[i];
  const auto at = [&](const ScalarOf<G>& step) {
    points[i] = GroupTraits<G>::compose(kept, GroupTraits<G>::exp(Tangent<G>::Unit(direction) * step));
    return f();
  };
  const auto minus = at(-h), plus = at(h);
  points[i] = kept;
  return std::pair(minus, plus);
}

}  // namespace splinertia::testing
