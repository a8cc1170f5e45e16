// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/spline/fit_options.hpp>
#include <splinertia/spline/smoothness.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia {

/// Several SmoothnessTerms as one.
template <typename Curve>
struct SmoothnessTerms {
  std::vector<SmoothnessTerm<Curve>> terms;

  template <typename System>
  typename Curve::Scalar add(const Curve& curve, System& system) const {
    typename Curve::Scalar cost(0);
    for (const auto& term : terms) cost += term.add(curve, system);
    return cost;
  }
};

/// Adds what keeps segments first … last from bending where the poses do not say how: the least acceleration (velocity,
/// of order 2). Beside a pose it weighs as if acceleration times interval² were known to be 0 to so many standard
/// deviations of a pose: thousands are nothing where there are poses, and all where there are none.
template <typename Curve>
void hold(SmoothnessTerms<Curve>& terms, const Curve& curve, const Tangent<typename Curve::Group>& standard_deviation,
          std::size_t first, std::size_t last, const typename Curve::Scalar& deviations) {
  using std::sqrt;
  using Scalar = typename Curve::Scalar;
  constexpr int derivative = Curve::order > 2 ? 2 : 1;
  const auto& knots = curve.knots();
  const Scalar length = seconds<Scalar>(knots.knot(last + 1, Curve::order) - knots.knot(first, Curve::order)) /
                        static_cast<Scalar>(last + 1 - first);
  if (!(length > Scalar(0))) return;
  const Scalar unit = derivative == 2 ? length * sqrt(length) : sqrt(length);
  terms.terms.emplace_back(derivative, deviations * standard_deviation / unit, first, last);
}

/// Holds the segments that the control points in gaps shape.
template <typename Curve>
void bridge(SmoothnessTerms<Curve>& terms, const Curve& curve, const Tangent<typename Curve::Group>& standard_deviation,
            const std::vector<FitGap<typename Curve::Time>>& gaps) {
  using std::sqrt;
  using Scalar = typename Curve::Scalar;
  constexpr std::size_t reach = Curve::order - 1;
  // Its square beside that of a pose is the root of the rounding.
  const Scalar deviations = Scalar(1) / sqrt(sqrt(std::numeric_limits<Scalar>::epsilon()));
  std::size_t next = 0;
  for (const auto& gap : gaps) {
    const std::size_t first = std::max(next, gap.first_control_point < reach ? 0 : gap.first_control_point - reach);
    const std::size_t last = std::min(gap.last_control_point, curve.segments() - 1);
    if (first > last) continue;
    next = last + 1;
    hold(terms, curve, standard_deviation, first, last, deviations);
  }
}

/// Holds the outermost Order − 2 segments at either end.
template <typename Curve>
void hold_ends(SmoothnessTerms<Curve>& terms, const Curve& curve,
               const Tangent<typename Curve::Group>& standard_deviation) {
  using Scalar = typename Curve::Scalar;
  const std::size_t last = curve.segments() - 1, reach = std::min<std::size_t>(Curve::order - 3, last);
  hold(terms, curve, standard_deviation, 0, reach, Scalar(10));
  hold(terms, curve, standard_deviation, last - reach, last, Scalar(10));
}

}  // namespace splinertia
