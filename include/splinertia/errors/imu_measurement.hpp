// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/lie_group.hpp>

namespace splinertia {

/// One measurement of both sensors, in the IMU's axes.
template <typename Scalar>
struct ImuMeasurement {
  Vector3<Scalar> gyro;   ///< angular velocity, rad/s
  Vector3<Scalar> accel;  ///< specific force, m/s²
};

/// A number that is finite if all of a measurement are, and their sum does not overflow, and that is not finite if one
/// of an ideal measurement is not. One component of the specific force stands for all three: the attitude has mixed
/// them, and even zero times NaN or infinity is NaN.
template <typename Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar finiteness(const ImuMeasurement<Scalar>& m) {
  return (m.gyro[0] + m.gyro[1]) + (m.gyro[2] + m.accel[0]);
}

}  // namespace splinertia
