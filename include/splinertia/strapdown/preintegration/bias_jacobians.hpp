// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/lie_group.hpp>

namespace splinertia {

/// The biases of an IMU: what it reads too much.
template <typename Scalar>
struct ImuBias {
  Vector3<Scalar> gyro = Vector3<Scalar>::Zero();   ///< rad/s
  Vector3<Scalar> accel = Vector3<Scalar>::Zero();  ///< m/s²
};

/// How a preintegrated motion changes with the biases it was computed with, all 3×3: ΔR(b + d) = ΔR exp(R_gyro d), Δv
/// and Δp additively.
template <typename Scalar>
struct BiasJacobians {
  Matrix3<Scalar> R_gyro = Matrix3<Scalar>::Zero();
  Matrix3<Scalar> v_gyro = Matrix3<Scalar>::Zero(), v_accel = Matrix3<Scalar>::Zero();
  Matrix3<Scalar> p_gyro = Matrix3<Scalar>::Zero(), p_accel = Matrix3<Scalar>::Zero();
};

}  // namespace splinertia
