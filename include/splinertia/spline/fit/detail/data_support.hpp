// SPDX-License-Identifier: MIT
/// Finds the control points that the poses do not determine, or determine badly.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <utility>
#include <vector>

namespace splinertia::detail {

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

/// The control points that the poses do not determine, in ascending order. A control point is determined if
/// - it can be assigned a pose of its own where its weight is at least a tenth of its largest weight anywhere
///   (Schoenberg and Whitney, Trans. Amer. Math. Soc. 74 (1953) 246: a spline of one dimension needs this), and
/// - its weight at some pose, which other control points may share, is at least a quarter of its largest (a cubic's
///   weight one interval away).
/// So the remaining control points are well determined. `counts(i)` tells whether pose i is used.
template <typename Curve>
[[nodiscard]] std::vector<std::size_t> undetermined_control_points(const KnotsOf<Curve>& knots,
                                                                   std::size_t control_points,
                                                                   const PosesOf<Curve>& poses, const auto& counts) {
  constexpr int order = Curve::order;
  const auto weights_at = [&](auto time) {
    const auto located = knots.template basis<double, order, 0>(time, control_points);
    return std::pair(located.first, control_point_weights(located.basis));
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

/// The control points, ascending, whose Order segments have at most 5/4 poses each on average. These are enough to
/// determine them one by one. But poses near the middle of every segment cannot detect an alternating change of the
/// control points: for a cubic the weights there are proportional to 1, 23, 23, 1, and 1 − 23 + 23 − 1 = 0.
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

}  // namespace splinertia::detail
