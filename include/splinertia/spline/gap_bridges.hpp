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

/// What holds the control points that the poses do not: the least acceleration (velocity, of order 2) over the segments
/// that these shape, so weak that the square root of the rounding is left of it beside a pose.
template <typename Curve>
[[nodiscard]] SmoothnessTerms<Curve> bridges(const Curve& curve, const std::vector<FitGap<typename Curve::Time>>& gaps,
                                             const Tangent<typename Curve::Group>& standard_deviation) {
  using std::sqrt;
  using Scalar = typename Curve::Scalar;
  constexpr std::size_t k = Curve::order;
  constexpr int derivative = k > 2 ? 2 : 1;
  SmoothnessTerms<Curve> result;
  std::size_t next = 0;
  for (const auto& gap : gaps) {
    const std::size_t first = std::max(next, gap.first_control_point < k - 1 ? 0 : gap.first_control_point - (k - 1));
    const std::size_t last = std::min(gap.last_control_point, curve.segments() - 1);
    if (first > last) continue;
    next = last + 1;
    const Scalar length = seconds<Scalar>(curve.knots().knot(last + 1, k) - curve.knots().knot(first, k)) /
                          static_cast<Scalar>(last + 1 - first);
    if (!(length > Scalar(0))) continue;
    const Scalar unit = derivative == 2 ? length * sqrt(length) : sqrt(length);
    const Scalar weakness = sqrt(sqrt(std::numeric_limits<Scalar>::epsilon()));
    result.terms.emplace_back(derivative, standard_deviation / (weakness * unit), first, last);
  }
  return result;
}

}  // namespace splinertia
