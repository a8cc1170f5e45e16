// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/spline/fit/detail/banded_system.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// The curve with every control point X_i replaced by X_i ⊞ step_i = X_i exp(step_i).
template <typename Curve>
[[nodiscard]] Curve retracted(const Curve& curve, const std::vector<Tangent<typename Curve::Group>>& step) {
  using G = typename Curve::Group;
  std::vector<G> points = curve.control_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = GroupTraits<G>::compose(points[i], GroupTraits<G>::exp(step[i]));
  }
  return Curve(curve.knots(), std::move(points));
}

/// The model of minimize() for one curve: its cost is the sum of several terms. Each term adds its squares to a
/// BandedSystem. A term may couple control points that are at most Reach apart.
template <typename Curve, int Reach, typename... Terms>
class CurveModel {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  using System = BandedSystem<Scalar, DofOf<G>, Reach>;

  explicit CurveModel(std::reference_wrapper<const Terms>... terms) : terms_(terms...) {}

  Scalar linearize(const Curve& curve, System& system) const {
    return std::apply([&](const auto&... term) { return (term.add(curve, system) + ...); }, terms_);
  }

  [[nodiscard]] Curve retracted(const Curve& curve, const typename System::Vector& step) const {
    return splinertia::detail::retracted(curve, step.blocks);
  }

 private:
  std::tuple<const Terms&...> terms_;
};

}  // namespace splinertia::detail
