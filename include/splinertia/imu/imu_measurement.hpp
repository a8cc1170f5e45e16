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

/// A number that is finite if all of a measurement are and their sum does not overflow.
template <typename Scalar>
[[nodiscard, gnu::always_inline]] inline Scalar finiteness(const ImuMeasurement<Scalar>& m) {
  return (m.gyro + m.accel).sum();
}

}  // namespace splinertia
