// SPDX-License-Identifier: MIT
/// Angular velocity, velocity, acceleration and specific force of a rigid body, from a motion on either group of poses.
/// R is R_WB, p is p_WB.
///
///   SO3xR3:  velocity [ω; ṗ],   acceleration [α; p̈]        with ṗ, p̈ in the world
///   SE3:     velocity [v; ω],   acceleration [v̇; α]        with v = Rᵀṗ in the body, so Rᵀp̈ = v̇ + ω × v
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/motion/detail/tangent_parts.hpp>
#include <splinertia/motion/motion.hpp>

namespace splinertia {

/// ω in the body, rad/s.
template <Pose G, int D>
  requires(D >= 1)
[[nodiscard]] Eigen::Vector3<ScalarOf<G>> angular_velocity(const Motion<G, D>& m) {
  return detail::rotational_part<G>(m.velocity);
}

/// α = dω/dt in the body, rad/s².
template <Pose G, int D>
  requires(D >= 2)
[[nodiscard]] Eigen::Vector3<ScalarOf<G>> angular_acceleration(const Motion<G, D>& m) {
  return detail::rotational_part<G>(m.acceleration);
}

/// ṗ in the world, m/s.
template <Pose G, int D>
  requires(D >= 1)
[[nodiscard]] Eigen::Vector3<ScalarOf<G>> world_velocity(const Motion<G, D>& m) {
  if constexpr (SplitPose<G>) {
    return detail::translational_part<G>(m.velocity);
  } else {
    return detail::rotate<ScalarOf<G>>(rotation(m.value).unit_quaternion(), detail::translational_part<G>(m.velocity));
  }
}

/// Rᵀ(p̈ − gravity): the specific force in the body, m/s². `gravity`: acceleration of free fall in the world, m/s².
template <Pose G, int D>
  requires(D >= 2)
[[nodiscard]] Eigen::Vector3<ScalarOf<G>> specific_force(const Motion<G, D>& m,
                                                         const Eigen::Vector3<ScalarOf<G>>& gravity) {
  using Scalar = ScalarOf<G>;
  const auto& q = rotation(m.value).unit_quaternion();
  const Eigen::Vector3<Scalar> v_dot = detail::translational_part<G>(m.acceleration);
  if constexpr (SplitPose<G>) {
    return detail::rotate_inverse<Scalar>(q, v_dot - gravity);
  } else {
    const Eigen::Vector3<Scalar> v = detail::translational_part<G>(m.velocity);
    return v_dot + angular_velocity(m).cross(v) - detail::rotate_inverse<Scalar>(q, gravity);
  }
}

}  // namespace splinertia
