// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/spline/pose_breaks.hpp>
#include <utility>
#include <vector>

namespace splinertia {

/// The first and the last pose behind the jumps at the ends. An estimator that begins with poses of identity, or a
/// tracker that ends with a wrong one, leaves up to 16 poses (an eighth of all) beyond a step that no motion explains.
/// Such poses are beside nothing that could show them wrong, so a curve meets them whatever the loss.
template <LieGroup G, TimePoint Time>
[[nodiscard]] std::pair<std::size_t, std::size_t> poses_between_jumps(const std::vector<Stamped<G, Time>>& poses) {
  const std::size_t n = poses.size(), reach = std::min<std::size_t>(16, n / 8);
  std::pair<std::size_t, std::size_t> between{0, n - 1};
  for (const std::size_t i : detail::breaks_between(poses)) {
    if (i < reach) between.first = i + 1;
    if (i + 1 + reach >= n) between.second = std::min(between.second, i);
  }
  return between;
}

}  // namespace splinertia
