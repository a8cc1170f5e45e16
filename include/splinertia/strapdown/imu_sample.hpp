// SPDX-License-Identifier: MIT
/// What an IMU delivers: values at points of time, or their integrals from one point to the next.
#pragma once

#include <concepts>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/time.hpp>
#include <type_traits>

namespace splinertia {

/// Anything with a time of this type. A bare integer is none: it does not say what it counts.
template <typename S, typename Time>
concept HasTime = requires(const S& s) {
  { s.time } -> std::convertible_to<Time>;
  requires !std::integral<std::remove_cvref_t<decltype(s.time)>>;
};

/// Anything with a time and the point samples of both sensors: gyro in rad/s, accel (specific force) in m/s².
template <typename S, typename Scalar, typename Time>
concept ImuSample = HasTime<S, Time> && requires(const S& s) {
  { s.gyro } -> std::convertible_to<Vector3<Scalar>>;
  { s.accel } -> std::convertible_to<Vector3<Scalar>>;
};

/// Anything with a time and what both sensors have summed up since the sample before: delta_angle in rad, the integral
/// of the angular velocity, and delta_velocity in m/s, that of the specific force, both in the turning axes of the
/// sensor.
template <typename S, typename Scalar, typename Time>
concept ImuIncrement = HasTime<S, Time> && requires(const S& s) {
  { s.delta_angle } -> std::convertible_to<Vector3<Scalar>>;
  { s.delta_velocity } -> std::convertible_to<Vector3<Scalar>>;
};

/// The least that is a point sample.
template <typename Scalar, TimePoint Time>
struct TimedImuSample {
  Time time;
  Vector3<Scalar> gyro;   ///< rad/s
  Vector3<Scalar> accel;  ///< m/s²
};

/// The least that is an increment.
template <typename Scalar, TimePoint Time>
struct TimedImuIncrement {
  Time time;                       ///< of its end
  Vector3<Scalar> delta_angle;     ///< rad
  Vector3<Scalar> delta_velocity;  ///< m/s
};

}  // namespace splinertia
