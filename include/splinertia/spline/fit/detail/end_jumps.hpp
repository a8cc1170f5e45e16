// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/spline/fit/detail/pose_breaks.hpp>
#include <splinertia/spline/fit/pose_statistics.hpp>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// Indices of the first and the last pose between the jumps at the ends. An estimator that begins with identity poses,
/// or a tracker that ends with a wrong pose, leaves up to 16 poses (at most an eighth of all) beyond a jump. A jump is
/// a break (pose_breaks.hpp) whose unexpected_step() in some component is more than ten times that of all steps but the
/// largest fiftieth (at least three). The poses beyond it have no neighbours that show them to be wrong, so a curve
/// would follow them whatever the loss.
template <LieGroup G, TimePoint Time>
[[nodiscard]] std::pair<std::size_t, std::size_t> poses_between_jumps(const std::vector<Stamped<G, Time>>& poses) {
  using Scalar = ScalarOf<G>;
  const std::size_t n = poses.size(), reach = std::min<std::size_t>(16, n / 8);
  std::pair<std::size_t, std::size_t> between{0, n - 1};
  if (reach < 1) return between;
  const auto at_an_end = [&](std::size_t i) { return i < reach || i + 1 + reach >= n; };
  auto breaks = breaks_between(poses);
  std::erase_if(breaks, [&](std::size_t i) { return !at_an_end(i); });
  if (breaks.empty()) return between;

  const double interval = median_interval(poses);
  std::vector<Tangent<G>> all;
  for (std::size_t i = 0; i + 2 < n; ++i) all.push_back(unexpected_step(poses, i, i + 1, interval));
  Tangent<G> usual;
  std::vector<Scalar> values(all.size());
  // One wrong pose makes up to three large values.
  const std::size_t left_out = (std::min)(values.size() - 1, std::max<std::size_t>(values.size() / 50, 3));
  const auto largest = values.end() - static_cast<std::ptrdiff_t>(left_out) - 1;
  for (int row = 0; row < usual.size(); ++row) {
    std::transform(all.begin(), all.end(), values.begin(), [row](const auto& step) { return step[row]; });
    std::nth_element(values.begin(), largest, values.end());
    usual[row] = *largest;
  }
  for (const std::size_t i : breaks) {
    const std::size_t beside = i + 2 < n ? i + 1 : i - 1;
    if (!(unexpected_step(poses, i, beside, interval).array() > Scalar(10) * usual.array()).any()) continue;
    if (i < reach) between.first = i + 1;
    if (i + 1 + reach >= n) between.second = (std::min)(between.second, i);
  }
  return between;
}

}  // namespace splinertia::detail
