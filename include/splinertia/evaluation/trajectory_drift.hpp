// SPDX-License-Identifier: MIT
/// Drift over segments of a given length, as the KITTI odometry benchmark defines it.
///
///   auto drift = error_statistics(drift_errors(pairs, 100), &PoseError<double>::translation);
///   100 * drift.mean;  // %
#pragma once

#include <algorithm>
#include <cstddef>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/evaluation/trajectory_error.hpp>
#include <splinertia/evaluation/trajectory_pairs.hpp>
#include <splinertia/group/pose.hpp>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace splinertia {

/// The length of the reference's path from the first pair to each pair, m.
template <Pose G, TimePoint Time>
[[nodiscard]] std::vector<ScalarOf<G>> reference_path(const std::vector<PosePair<G, Time>>& pairs) {
  std::vector<ScalarOf<G>> path(pairs.size(), ScalarOf<G>(0));
  for (std::size_t i = 1; i < path.size(); ++i) {
    path[i] = path[i - 1] + (position(pairs[i].reference) - position(pairs[i - 1].reference)).norm();
  }
  return path;
}

/// The relative_errors() of segments divided by `length`: translation in m/m, rotation in rad/m. A segment begins at
/// every `step`-th pair and ends at the first pair for which the reference's path from its beginning is longer than
/// `length`. The result is empty if the path is too short. Geiger, Lenz and Urtasun, "Are we ready for autonomous
/// driving? The KITTI vision benchmark suite", CVPR 2012, and the benchmark's development kit, which takes every tenth
/// pair and lengths of 100, 200, …, 800 m, and ranks by the mean of all. Throws std::invalid_argument unless the length
/// is finite and > 0, and for step 0.
template <Pose G, TimePoint Time>
[[nodiscard]] std::vector<PoseError<ScalarOf<G>>> drift_errors(const std::vector<PosePair<G, Time>>& pairs,
                                                               std::type_identity_t<ScalarOf<G>> length,
                                                               std::size_t step = 10) {
  if (!(length > ScalarOf<G>(0)) || !detail::is_finite(length)) {
    detail::refuse<std::invalid_argument>("drift_errors: length ", length, " m, expected a length > 0");
  }
  if (step == 0) detail::refuse<std::invalid_argument>("drift_errors: step 0, expected 1 or more");
  const auto path = reference_path(pairs);
  IndexPairs segments;
  for (std::size_t i = 0; i < path.size(); i += (std::min)(step, path.size() - i)) {
    const auto end = std::upper_bound(path.begin() + static_cast<std::ptrdiff_t>(i), path.end(), path[i] + length);
    if (end == path.end()) break;
    segments.emplace_back(i, static_cast<std::size_t>(end - path.begin()));
  }
  auto errors = relative_errors(pairs, segments);
  for (auto& [translation, rotation] : errors) {
    translation /= length;
    rotation /= length;
  }
  return errors;
}

}  // namespace splinertia
