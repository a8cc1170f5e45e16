// SPDX-License-Identifier: MIT
/// Which control points are determined by what the curve is fitted to.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <utility>
#include <vector>

namespace splinertia {

/// The weights B_j = λ_j − λ_{j+1} of the Order control points of a segment.
template <typename Scalar, int Order>
[[nodiscard]] FixedArray<Scalar, Order> control_point_weights(const CumulativeBasis<Scalar, Order, 0>& basis) {
  FixedArray<Scalar, Order> weights;
  Scalar before(1);
  for (std::size_t j = 0; j + 1 < weights.size(); ++j) {
    weights[j] = before - basis.lambda[0][j];
    before = basis.lambda[0][j];
  }
  weights.back() = before;
  return weights;
}

/// The control points that the poses leave undetermined, in ascending order: there are too few poses where these have a
/// share in the curve. Each control point is given one pose of its own (Schoenberg and Whitney, Trans. Amer. Math. Soc.
/// 74 (1953) 246, say that this is what a spline of one dimension needs), at which its weight is at least a tenth of
/// the largest that it has anywhere; and one pose, which others may be given, has to be near enough for a quarter of it
/// (a cubic's weight one interval off). So what is left to the others is well determined, too. `counts(i)` says whether
/// pose i counts at all.
template <typename Curve>
[[nodiscard]] std::vector<std::size_t> undetermined_control_points(const KnotsOf<Curve>& knots,
                                                                   std::size_t control_points,
                                                                   const PosesOf<Curve>& poses, const auto& counts) {
  constexpr int order = Curve::order;
  const auto weights_at = [&](auto time) {
    const auto place = knots.template basis<double, order, 0>(time, control_points);
    return std::pair(place.first, control_point_weights(place.basis));
  };
  std::vector<double> largest(control_points, 0.0);
  for (std::size_t s = 0; s + order <= control_points; ++s) {
    const auto begin = knots.knot(s, order), end = knots.knot(s + 1, order);
    for (const auto time : {begin, begin + (end - begin) / 2, end}) {
      const auto [first, weights] = weights_at(time);
      for (std::size_t j = 0; j < weights.size(); ++j) largest[first + j] = (std::max)(largest[first + j], weights[j]);
    }
  }
  std::vector<bool> nearby(control_points, false), matched(control_points, false);
  std::size_t next = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!counts(i)) continue;
    const auto [first, weights] = weights_at(poses[i].time);
    const auto share = [&, first = first, &weights = weights](std::size_t j) {
      return weights[j] / largest[first + j];
    };
    std::size_t low = 0, high = weights.size();
    while (low < high && share(low) < 0.1) ++low;
    while (high > low && share(high - 1) < 0.1) --high;
    for (std::size_t j = low; j < high; ++j) nearby[first + j] = nearby[first + j] || share(j) >= 0.25 - 1e-9;
    next = (std::max)(next, first + low);
    if (next < first + high) matched[next++] = true;
  }
  std::vector<std::size_t> undetermined;
  for (std::size_t i = 0; i < control_points; ++i) {
    if (!nearby[i] || !matched[i]) undetermined.push_back(i);
  }
  return undetermined;
}

/// The control points, ascending, whose Order segments have at most 5/4 poses each. Though enough to determine them one
/// by one, poses near the middle of every segment leave control points that alternate: of a cubic, 1 − 23 + 23 − 1.
template <typename Curve>
[[nodiscard]] std::vector<std::size_t> thinly_measured_control_points(const KnotsOf<Curve>& knots,
                                                                      std::size_t control_points,
                                                                      const PosesOf<Curve>& poses, const auto& counts) {
  constexpr std::size_t order = Curve::order;
  std::vector<typename Curve::Time> times;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (counts(i)) times.push_back(poses[i].time);
  }
  std::vector<std::size_t> thin;
  for (std::size_t c = order - 1; c + order <= control_points; ++c) {
    const auto from = std::lower_bound(times.begin(), times.end(), knots.knot(c + 1 - order, Curve::order));
    const auto to = std::lower_bound(from, times.end(), knots.knot(c + 1, Curve::order));
    if (4 * static_cast<std::size_t>(to - from) <= 5 * order) thin.push_back(c);
  }
  return thin;
}

}  // namespace splinertia
