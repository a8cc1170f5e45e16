// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <splinertia/group/pose.hpp>

namespace splinertia::detail {

/// The rotational part of a tangent vector of a pose: its first rows for SO3xR3, its last for SE3.
template <Pose G>
[[nodiscard]] Eigen::Vector3<ScalarOf<G>> rotational_part(const Tangent<G>& tau) {
  return tau.template segment<3>(SplitPose<G> ? 0 : 3);
}

/// The translational part of a tangent vector of a pose.
template <Pose G>
[[nodiscard]] Eigen::Vector3<ScalarOf<G>> translational_part(const Tangent<G>& tau) {
  return tau.template segment<3>(SplitPose<G> ? 3 : 0);
}

}  // namespace splinertia::detail
