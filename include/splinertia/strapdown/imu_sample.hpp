// SPDX-License-Identifier: MIT
/// The output of an IMU: point samples, which are values at a time, or increments, which are integrals from one time to
/// the next.
#pragma once

#include <concepts>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/time.hpp>
#include <type_traits>

namespace splinertia {

/// Has a member `time` of this type. Bare integers are not times, because their unit is unknown.
template <typename S, typename Time>
concept HasTime = requires(const S& s) {
  { s.time } -> std::convertible_to<Time>;
  requires !std::integral<std::remove_cvref_t<decltype(s.time)>>;
};

/// A point sample of both sensors: has time, gyro (angular velocity, rad/s) and accel (specific force, m/s²).
template <typename S, typename Scalar, typename Time>
concept ImuSample = HasTime<S, Time> && requires(const S& s) {
  { s.gyro } -> std::convertible_to<Vector3<Scalar>>;
  { s.accel } -> std::convertible_to<Vector3<Scalar>>;
};

/// An increment of both sensors since the sample before: has time, delta_angle (integral of the angular velocity, rad)
/// and delta_velocity (integral of the specific force, m/s), both in the turning axes of the sensor.
template <typename S, typename Scalar, typename Time>
concept ImuIncrement = HasTime<S, Time> && requires(const S& s) {
  { s.delta_angle } -> std::convertible_to<Vector3<Scalar>>;
  { s.delta_velocity } -> std::convertible_to<Vector3<Scalar>>;
};

/// The minimal type that satisfies ImuSample.
template <typename Scalar, TimePoint Time>
struct TimedImuSample {
  Time time;
  Vector3<Scalar> gyro;   ///< rad/s
  Vector3<Scalar> accel;  ///< m/s²
};

/// The minimal type that satisfies ImuIncrement.
template <typename Scalar, TimePoint Time>
struct TimedImuIncrement {
  Time time;                       ///< end of the interval
  Vector3<Scalar> delta_angle;     ///< rad
  Vector3<Scalar> delta_velocity;  ///< m/s
};

}  // namespace splinertia
