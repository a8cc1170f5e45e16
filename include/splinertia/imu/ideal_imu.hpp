// SPDX-License-Identifier: MIT
/// What a perfect IMU measures.
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/imu/imu_measurement.hpp>
#include <splinertia/imu/mounting.hpp>
#include <splinertia/motion/kinematics.hpp>

namespace splinertia {

/// The acceleration of free fall in the world, m/s²: standard gravity (ISO 80000-3), z up.
template <typename Scalar>
[[nodiscard]] Eigen::Vector3<Scalar> standard_gravity() {
  return {Scalar(0), Scalar(0), Scalar(-980665) / Scalar(100000)};
}

/// The measurement of an IMU in the body frame: gyro = ω, accel = Rᵀ(p̈ − gravity). `gravity` in the world, m/s².
template <Pose G, int D>
  requires(D >= 2)
[[nodiscard]] ImuMeasurement<ScalarOf<G>> ideal_imu(
    const Motion<G, D>& motion, const Eigen::Vector3<ScalarOf<G>>& gravity = standard_gravity<ScalarOf<G>>()) {
  return {angular_velocity(motion), specific_force(motion, gravity)};
}

/// The measurement of an IMU mounted on the body, with lever arm l = p_BI. It adds the Euler term α × l and the
/// centripetal term ω × (ω × l) to the specific force at the body's origin, and rotates both readings into the IMU's
/// axes. Savage, Strapdown Analytics (2000), 7.1.
template <Pose G, int D>
  requires(D >= 2)
[[nodiscard]] ImuMeasurement<ScalarOf<G>> ideal_imu(const Motion<G, D>& motion,
                                                    const Eigen::Vector3<ScalarOf<G>>& gravity,
                                                    const Mounting<ScalarOf<G>>& mounting) {
  using Scalar = ScalarOf<G>;
  const auto [omega, force] = ideal_imu(motion, gravity);
  const auto& q_BI = mounting.R_BI.unit_quaternion();
  const auto& l = mounting.p_BI;
  const Eigen::Vector3<Scalar> at_imu = force + angular_acceleration(motion).cross(l) + omega.cross(omega.cross(l));
  return {detail::rotate_inverse<Scalar>(q_BI, omega), detail::rotate_inverse<Scalar>(q_BI, at_imu)};
}

namespace detail {

/// In place of a Mounting: the IMU is the body frame. Costs nothing.
struct NotMounted {};

}  // namespace detail

}  // namespace splinertia
