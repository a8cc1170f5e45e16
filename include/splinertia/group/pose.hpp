// SPDX-License-Identifier: MIT
/// Poses T_WB in three dimensions, on either of two groups: SO(3) × R³ (rotation and position apart) or SE(3).
#pragma once

#include <concepts>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/group/product.hpp>
#include <splinertia/group/sophus.hpp>

namespace splinertia {

/// Rotation and position as a product of two groups. Tangents are [rotation; translation].
template <typename Scalar>
using SO3xR3 = Product<Sophus::SO3<Scalar>, Eigen::Vector3<Scalar>>;

template <typename G>
concept SplitPose = std::same_as<G, SO3xR3<ScalarOf<G>>>;

namespace detail {

template <typename G>
concept RigidPose = std::same_as<G, Sophus::SE3<ScalarOf<G>>>;

}  // namespace detail

template <typename G>
concept Pose = SplitPose<G> || detail::RigidPose<G>;

/// R_WB.
template <Pose G>
[[nodiscard]] const Sophus::SO3<ScalarOf<G>>& rotation(const G& pose) {
  if constexpr (SplitPose<G>) {
    return pose.template get<0>();
  } else {
    return pose.so3();
  }
}

/// p_WB.
template <Pose G>
[[nodiscard]] const Eigen::Vector3<ScalarOf<G>>& position(const G& pose) {
  if constexpr (SplitPose<G>) {
    return pose.template get<1>();
  } else {
    return pose.translation();
  }
}

/// The pose with the rotation R_WB and the position p_WB.
template <Pose G>
[[nodiscard]] G make_pose(const Sophus::SO3<ScalarOf<G>>& R_WB, const Eigen::Vector3<ScalarOf<G>>& p_WB) {
  if constexpr (SplitPose<G>) {
    return {R_WB, p_WB};
  } else {
    G pose;
    pose.so3() = R_WB;
    pose.translation() = p_WB;
    return pose;
  }
}

}  // namespace splinertia
