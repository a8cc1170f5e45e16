// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/sensor_kind.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

namespace detail {

/// Whether a type is a bare error term, which needs an ErrorModel around it.
template <typename T>
inline constexpr bool is_term = ErrorTerm<T> && !SensorModel<T> && !ClockModel<T>;

}  // namespace detail

/// The errors of an IMU: of its two sensors and of the time stamps of its samples. Write Imu{gyro, accel} or
/// Imu{gyro, accel, stamps}; a part that is {} has no errors.
template <typename Gyro = ErrorModel<>, typename Accel = ErrorModel<>, typename Stamps = ErrorModel<>>
struct Imu {
  static_assert(!detail::is_term<Gyro> && !detail::is_term<Accel> && !detail::is_term<Stamps>,
                "an Imu has an ErrorModel for each sensor: Imu{ErrorModel{WhiteNoise{0.01}}, ErrorModel{}}");
  static_assert(
      detail::SensorModel<Gyro> || detail::is_term<Gyro>,
      "the first part of an Imu is its gyroscope's ErrorModel; errors of time stamps (ClockOffset, StampJitter, …) "
      "are the third: Imu{gyro, accel, stamps}");
  static_assert(
      detail::SensorModel<Accel> || detail::is_term<Accel>,
      "the second part of an Imu is its accelerometer's ErrorModel; errors of time stamps (ClockOffset, StampJitter, "
      "…) are the third: Imu{gyro, accel, stamps}");
  static_assert(
      detail::ClockModel<Stamps> || detail::is_term<Stamps>,
      "the third part of an Imu is the ErrorModel of its stamps (ClockOffset, StampJitter, …): Imu{gyro, accel, "
      "stamps}");
  static_assert(detail::is_for<Gyro, SensorKind::gyro>,
                "the first part of an Imu is its gyroscope's ErrorModel, but a term in it is for accelerometers "
                "(SizeEffect)");
  static_assert(detail::is_for<Accel, SensorKind::accel>,
                "the second part of an Imu is its accelerometer's ErrorModel, but a term in it is for gyroscopes "
                "(GSensitivity, GSquaredSensitivity)");

  [[no_unique_address]] Gyro gyro{};
  [[no_unique_address]] Accel accel{};
  [[no_unique_address]] Stamps stamps{};
};

// Parts that are {} have no errors.
template <typename Gyro = ErrorModel<>, typename Accel = ErrorModel<>, typename Stamps = ErrorModel<>>
Imu(Gyro, Accel, Stamps) -> Imu<Gyro, Accel, Stamps>;
template <typename Gyro = ErrorModel<>, typename Accel = ErrorModel<>>
Imu(Gyro, Accel) -> Imu<Gyro, Accel>;
template <typename Gyro>
Imu(Gyro) -> Imu<Gyro>;

namespace detail {

template <typename T>
inline constexpr bool is_imu = false;
template <typename Gyro, typename Accel, typename Stamps>
inline constexpr bool is_imu<Imu<Gyro, Accel, Stamps>> = true;

}  // namespace detail

/// One simulated sample: a sample with the true biases that it contains.
template <typename Scalar = double, TimePoint Time = double>
struct BasicImuReading : ImuSample<Scalar, Time> {
  Eigen::Vector3<Scalar> gyro_bias;   ///< in `gyro`, rad/s
  Eigen::Vector3<Scalar> accel_bias;  ///< in `accel`, m/s²
};

using ImuReading = BasicImuReading<>;

/// One simulated sample of an IMU whose stamps have errors, too.
template <typename Scalar = double, TimePoint Time = double>
struct StampedImuReading : BasicImuReading<Scalar, Time> {
  Time true_time;  ///< when the sample was taken
};

}  // namespace splinertia
