// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/motion/motion.hpp>

namespace splinertia {

/// Pose, velocities and accelerations of a rigid body at one time, as analytic motions compute them.
template <typename Scalar>
struct RigidBodyState {
  Eigen::Quaternion<Scalar> q_WB;
  Eigen::Vector3<Scalar> p_WB;   ///< m
  Eigen::Vector3<Scalar> omega;  ///< body, rad/s
  Eigen::Vector3<Scalar> v_WB;   ///< world, m/s
  Eigen::Vector3<Scalar> alpha;  ///< body, rad/s²
  Eigen::Vector3<Scalar> a_WB;   ///< world, m/s²
};

/// The value and the first D derivatives of this state, as a motion on SO(3) × R³.
template <int D, typename Scalar>
  requires(D <= 2)
[[nodiscard]] Motion<SO3xR3<Scalar>, D> split_motion(const RigidBodyState<Scalar>& s) {
  Motion<SO3xR3<Scalar>, D> m;
  m.value = SO3xR3<Scalar>{rotation_from_unit_quaternion(s.q_WB), s.p_WB};
  if constexpr (D >= 1) m.velocity << s.omega, s.v_WB;
  if constexpr (D >= 2) m.acceleration << s.alpha, s.a_WB;
  return m;
}

}  // namespace splinertia
