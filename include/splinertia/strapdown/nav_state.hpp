// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/imu/mounting.hpp>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/strapdown/detail/advance_attitude.hpp>
#include <splinertia/strapdown/detail/galilean.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

/// Attitude, velocity and position of the body in the world, and their time.
template <typename Scalar = double, TimePoint T = double>
struct NavState {
  using Time = T;

  Sophus::SO3<Scalar> R_WB;
  Eigen::Vector3<Scalar> v_WB;  ///< m/s
  Eigen::Vector3<Scalar> p_WB;  ///< m
  Time time;
};

/// The state that belongs to `motion`, with the given time.
template <Pose G, int D, TimePoint Time>
  requires(D >= 1)
[[nodiscard]] NavState<ScalarOf<G>, Time> nav_state(const Motion<G, D>& motion, Time time) {
  return {rotation(motion.value), world_velocity(motion), position(motion.value), time};
}

/// The state of an IMU that is mounted on the body: R_WB R_BI, v_WB + R_WB (ω × p_BI), p_WB + R_WB p_BI. The
/// integration of what this IMU measures begins there.
template <Pose G, int D, TimePoint Time>
  requires(D >= 1)
[[nodiscard]] NavState<ScalarOf<G>, Time> nav_state(const Motion<G, D>& motion, Time time,
                                                    const Mounting<ScalarOf<G>>& mounting) {
  using Scalar = ScalarOf<G>;
  const G imu = imu_pose(motion.value, mounting);
  const Eigen::Vector3<Scalar> turn = angular_velocity(motion).cross(mounting.p_BI);
  return {rotation(imu),
          world_velocity(motion) + detail::rotate<Scalar>(rotation(motion.value).unit_quaternion(), turn),
          position(imu), time};
}

/// The pose of a state, with its time: for writers, fit() and associate().
template <typename Scalar, TimePoint Time>
[[nodiscard]] Stamped<SO3xR3<Scalar>, Time> stamped_pose(const NavState<Scalar, Time>& state) {
  return {state.time, {state.R_WB, state.p_WB}};
}

/// An inertial world, the default Frame: the motion is what the IMU has measured plus gravity.
///   R₁ = R₀ ΔR,  v₁ = v₀ + g h + R₀ Δv,  p₁ = p₀ + v₀ h + g h²/2 + R₀ Δp
struct InertialFrame {
  template <typename Scalar, typename Time>
  [[nodiscard]] NavState<Scalar, Time> advance(const NavState<Scalar, Time>& state,
                                               const detail::NavIncrement<Scalar>& increment,
                                               const Eigen::Vector3<Scalar>& gravity, Time time) const {
    const auto& q = state.R_WB.unit_quaternion();
    const Scalar h = increment.interval;
    const Eigen::Vector3<Scalar> fall = gravity * h;
    return {detail::advance_attitude<Scalar>(q, increment.rotation),
            state.v_WB + fall + detail::rotate<Scalar>(q, increment.velocity),
            state.p_WB + (state.v_WB + fall / Scalar(2)) * h + detail::rotate<Scalar>(q, increment.position), time};
  }
};

}  // namespace splinertia
