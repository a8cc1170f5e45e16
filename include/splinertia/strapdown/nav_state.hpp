// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

/// Attitude, velocity and position of the body in the world at a time.
template <typename Scalar, TimePoint T = double>
struct NavState {
  using Time = T;

  Sophus::SO3<Scalar> R_WB;
  Vector3<Scalar> v_WB;  ///< m/s
  Vector3<Scalar> p_WB;  ///< m
  Time time;
};

/// The state of a body that moves as `motion` says, at `time`.
template <Pose G, int D, TimePoint Time>
  requires(D >= 1)
[[nodiscard]] NavState<ScalarOf<G>, Time> nav_state(const Motion<G, D>& motion, Time time) {
  return {rotation(motion.value), world_velocity(motion), position(motion.value), time};
}

/// R exp(φ), kept on the unit sphere: rounding alone would let the norm drift with the square root of the steps.
template <typename Scalar>
[[nodiscard]] Sophus::SO3<Scalar> advance_attitude(const Sophus::SO3<Scalar>& R, const Vector3<Scalar>& phi) {
  const Eigen::Quaternion<Scalar> q = R.unit_quaternion() * rotation_exp<Scalar>(phi);
  // One Newton step for 1/|q|, exact to rounding this close to 1.
  const Scalar scale = (Scalar(3) - q.squaredNorm()) / Scalar(2);
  return rotation_from_unit_quaternion(Eigen::Quaternion<Scalar>(q.coeffs() * scale));
}

}  // namespace splinertia
