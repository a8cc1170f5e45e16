// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/lie_group.hpp>
#include <splinertia/imu/error_model.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

/// The errors of an IMU: of its two sensors, and of the stamps that its samples get. Imu{gyro, accel},
/// Imu{gyro, accel, stamps}.
template <typename Gyro = ErrorModel<>, typename Accel = ErrorModel<>, typename Stamps = ErrorModel<>>
struct Imu {
  [[no_unique_address]] Gyro gyro{};
  [[no_unique_address]] Accel accel{};
  [[no_unique_address]] Stamps stamps{};
};

template <typename Gyro, typename Accel>
Imu(Gyro, Accel) -> Imu<Gyro, Accel>;
template <typename Gyro, typename Accel, typename Stamps>
Imu(Gyro, Accel, Stamps) -> Imu<Gyro, Accel, Stamps>;

/// One simulated sample.
template <typename Scalar, TimePoint Time>
struct BasicImuReading {
  Time time;                   ///< its stamp
  Vector3<Scalar> gyro;        ///< rad/s
  Vector3<Scalar> accel;       ///< m/s²
  Vector3<Scalar> gyro_bias;   ///< the true bias in `gyro`
  Vector3<Scalar> accel_bias;  ///< the true bias in `accel`
};

using ImuReading = BasicImuReading<double, double>;

/// One of an IMU whose stamps have errors, too.
template <typename Scalar, TimePoint Time>
struct StampedImuReading : BasicImuReading<Scalar, Time> {
  Time true_time;  ///< when the sample was taken
};

}  // namespace splinertia
