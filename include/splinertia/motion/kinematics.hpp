// SPDX-License-Identifier: MIT
/// Angular velocity, velocity, acceleration and specific force of a rigid body, from a motion on either group of poses.
/// R is R_WB, p is p_WB.
///
///   SO3xR3:  velocity [ω; ṗ],   acceleration [α; p̈]        with ṗ, p̈ in the world
///   SE3:     velocity [v; ω],   acceleration [v̇; α]        with v = Rᵀṗ in the body, so Rᵀp̈ = v̇ + ω × v
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/motion/motion.hpp>

namespace splinertia {

/// ω in the body, rad/s.
template <Pose G, int D>
  requires(D >= 1)
[[nodiscard]] Vector3<ScalarOf<G>> angular_velocity(const Motion<G, D>& m) {
  if constexpr (SplitPose<G>) {
    return m.velocity.template head<3>();
  } else {
    return m.velocity.template tail<3>();
  }
}

/// α = dω/dt in the body, rad/s².
template <Pose G, int D>
  requires(D >= 2)
[[nodiscard]] Vector3<ScalarOf<G>> angular_acceleration(const Motion<G, D>& m) {
  if constexpr (SplitPose<G>) {
    return m.acceleration.template head<3>();
  } else {
    return m.acceleration.template tail<3>();
  }
}

/// ṗ in the world, m/s.
template <Pose G, int D>
  requires(D >= 1)
[[nodiscard]] Vector3<ScalarOf<G>> world_velocity(const Motion<G, D>& m) {
  if constexpr (SplitPose<G>) {
    return m.velocity.template tail<3>();
  } else {
    return detail::rotate<ScalarOf<G>>(rotation(m.value).unit_quaternion(), m.velocity.template head<3>());
  }
}

/// Rᵀ(p̈ − gravity): the specific force in the body, m/s². `gravity`: acceleration of free fall in the world, m/s².
template <Pose G, int D>
  requires(D >= 2)
[[nodiscard]] Vector3<ScalarOf<G>> specific_force(const Motion<G, D>& m, const Vector3<ScalarOf<G>>& gravity) {
  using Scalar = ScalarOf<G>;
  const auto& q = rotation(m.value).unit_quaternion();
  if constexpr (SplitPose<G>) {
    return detail::rotate_inverse<Scalar>(q, m.acceleration.template tail<3>() - gravity);
  } else {
    const Vector3<Scalar> v = m.velocity.template head<3>();
    const Vector3<Scalar> v_dot = m.acceleration.template head<3>();
    return v_dot + angular_velocity(m).cross(v) - detail::rotate_inverse<Scalar>(q, gravity);
  }
}

}  // namespace splinertia
