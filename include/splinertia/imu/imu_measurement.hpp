// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/inline.hpp>
#include <splinertia/group/lie_group.hpp>

namespace splinertia {

/// One measurement of both sensors, in the IMU's axes.
template <typename Scalar>
struct ImuMeasurement {
  Eigen::Vector3<Scalar> gyro;   ///< angular velocity, rad/s
  Eigen::Vector3<Scalar> accel;  ///< specific force, m/s²
};

namespace detail {

/// A number to test instead of every component. It is finite if all components are and their sum does not overflow. It
/// is not finite if any component of an ideal measurement is not. accel[0] stands for the whole specific force, because
/// the attitude has mixed its components, and even zero times NaN or infinity is NaN.
template <typename Scalar>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Scalar finiteness(const ImuMeasurement<Scalar>& m) {
  return (m.gyro[0] + m.gyro[1]) + (m.gyro[2] + m.accel[0]);
}

}  // namespace detail

}  // namespace splinertia
