// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/lie_group.hpp>

namespace splinertia {

/// Additive biases of an IMU: reading = truth + bias.
template <typename Scalar = double>
struct ImuBias {
  Eigen::Vector3<Scalar> gyro = Eigen::Vector3<Scalar>::Zero();   ///< rad/s
  Eigen::Vector3<Scalar> accel = Eigen::Vector3<Scalar>::Zero();  ///< m/s²
};

namespace detail {

/// Derivatives of a preintegrated motion with respect to the biases it was computed with, all 3×3:
///   ΔR(b + d) = ΔR exp(R_gyro d_gyro),  Δv(b + d) = Δv + v_gyro d_gyro + v_accel d_accel,  Δp likewise
template <typename Scalar>
struct BiasJacobians {
  Eigen::Matrix3<Scalar> R_gyro = Eigen::Matrix3<Scalar>::Zero();
  Eigen::Matrix3<Scalar> v_gyro = Eigen::Matrix3<Scalar>::Zero(), v_accel = Eigen::Matrix3<Scalar>::Zero();
  Eigen::Matrix3<Scalar> p_gyro = Eigen::Matrix3<Scalar>::Zero(), p_accel = Eigen::Matrix3<Scalar>::Zero();
};

}  // namespace detail

}  // namespace splinertia
