// SPDX-License-Identifier: MIT
/// The calibration of an IMU: how its readings differ from ideal ones in the body frame, as far as a known motion shows
/// it.
#pragma once

#include <splinertia/group/pose.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/motion/detail/tangent_parts.hpp>
#include <splinertia/motion/kinematics.hpp>

namespace splinertia {

/// The reading at the IMU's time t, with the motion taken at t + time_offset:
///   gyro  = R_BIᵀ ω + gyro_bias
///   accel = R_BIᵀ (Rᵀ(p̈ − gravity) + α × p_BI + ω × (ω × p_BI)) + accel_bias
template <typename Scalar>
struct ImuCalibration {
  Eigen::Vector3<Scalar> gyro_bias = Eigen::Vector3<Scalar>::Zero();   ///< rad/s
  Eigen::Vector3<Scalar> accel_bias = Eigen::Vector3<Scalar>::Zero();  ///< m/s²
  Eigen::Vector3<Scalar> gravity = standard_gravity<Scalar>();  ///< acceleration of free fall in the world, m/s²
  Mounting<Scalar> mounting{};
  double time_offset = 0;  ///< s: the motion's clock minus the IMU's
};

/// The reading that this calibration predicts; `motion` is that at the sample's time + time_offset.
template <Pose G, int D>
  requires(D >= 2)
[[nodiscard]] ImuMeasurement<ScalarOf<G>> predicted_imu(const Motion<G, D>& motion,
                                                        const ImuCalibration<ScalarOf<G>>& calibration) {
  auto reading = ideal_imu(motion, calibration.gravity, calibration.mounting);
  reading.gyro += calibration.gyro_bias;
  reading.accel += calibration.accel_bias;
  return reading;
}

namespace detail {

/// The time derivative of that reading: [gyro; accel], rad/s² and m/s³.
template <Pose G>
[[nodiscard]] Eigen::Matrix<ScalarOf<G>, 6, 1> predicted_imu_rate(const Motion<G, 3>& m,
                                                                  const ImuCalibration<ScalarOf<G>>& calibration) {
  using Scalar = ScalarOf<G>;
  const auto& q = rotation(m.value).unit_quaternion();
  const auto& q_BI = calibration.mounting.R_BI.unit_quaternion();
  const Eigen::Vector3<Scalar>& l = calibration.mounting.p_BI;
  const Eigen::Vector3<Scalar> omega = angular_velocity(m), alpha = angular_acceleration(m);
  const Eigen::Vector3<Scalar> alpha_rate = rotational_part<G>(m.jerk);
  Eigen::Vector3<Scalar> force_rate = translational_part<G>(m.jerk);
  if constexpr (SplitPose<G>) {
    force_rate = rotate_inverse<Scalar>(q, force_rate) - omega.cross(specific_force(m, calibration.gravity));
  } else {
    const Eigen::Vector3<Scalar> v = translational_part<G>(m.velocity);
    const Eigen::Vector3<Scalar> v_dot = translational_part<G>(m.acceleration);
    force_rate += alpha.cross(v) + omega.cross(v_dot) + omega.cross(rotate_inverse<Scalar>(q, calibration.gravity));
  }
  force_rate += alpha_rate.cross(l) + alpha.cross(omega.cross(l)) + omega.cross(alpha.cross(l));
  Eigen::Matrix<Scalar, 6, 1> rate;
  rate.template head<3>() = rotate_inverse<Scalar>(q_BI, alpha);
  rate.template tail<3>() = rotate_inverse<Scalar>(q_BI, force_rate);
  return rate;
}

}  // namespace detail

}  // namespace splinertia
