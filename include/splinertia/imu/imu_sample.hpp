// SPDX-License-Identifier: MIT
/// The output of an IMU: point samples, which are values at a time, or increments, which are integrals from one time to
/// the next. Readers return ImuSample, simulate() yields what derives from it, and integrators, containers and writers
/// take it. Functions that take samples also take any struct with the same members.
#pragma once

#include <concepts>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/time.hpp>
#include <type_traits>

namespace splinertia {

/// A reading of both sensors at one time, in the IMU's axes.
template <typename Scalar = double, TimePoint Time = double>
struct ImuSample {
  Time time;
  Eigen::Vector3<Scalar> gyro;   ///< angular velocity, rad/s
  Eigen::Vector3<Scalar> accel;  ///< specific force, m/s²
};

/// The integrals of both readings since the increment before, both in the turning axes of the IMU, without corrections
/// for coning and sculling.
template <typename Scalar = double, TimePoint Time = double>
struct ImuIncrement {
  Time time;                              ///< end of the interval
  Eigen::Vector3<Scalar> delta_angle;     ///< integral of the angular velocity, rad
  Eigen::Vector3<Scalar> delta_velocity;  ///< integral of the specific force, m/s
};

/// Has the members of an ImuSample, of any scalar and any type of time.
template <typename S>
concept ImuSampleLike = detail::WithTime<S> && requires(const S& s) {
  requires std::remove_cvref_t<decltype(s.gyro)>::SizeAtCompileTime == 3;
  requires std::remove_cvref_t<decltype(s.accel)>::SizeAtCompileTime == 3;
};

/// Has the members of an ImuIncrement, of any scalar and any type of time.
template <typename S>
concept ImuIncrementLike = detail::WithTime<S> && requires(const S& s) {
  requires std::remove_cvref_t<decltype(s.delta_angle)>::SizeAtCompileTime == 3;
  requires std::remove_cvref_t<decltype(s.delta_velocity)>::SizeAtCompileTime == 3;
};

namespace detail {

/// Has a member `time` that converts to this type. Bare integers are not times, because their unit is unknown.
template <typename S, typename Time>
concept HasTime = requires(const S& s) {
  { s.time } -> std::convertible_to<Time>;
  requires !std::integral<std::remove_cvref_t<decltype(s.time)>>;
};

/// Has the members of an ImuSample<Scalar, Time>, or what converts to them.
template <typename S, typename Scalar, typename Time>
concept ImuSampleOf = HasTime<S, Time> && requires(const S& s) {
  { s.gyro } -> std::convertible_to<Eigen::Vector3<Scalar>>;
  { s.accel } -> std::convertible_to<Eigen::Vector3<Scalar>>;
};

/// Has the members of an ImuIncrement<Scalar, Time>, or what converts to them.
template <typename S, typename Scalar, typename Time>
concept ImuIncrementOf = HasTime<S, Time> && requires(const S& s) {
  { s.delta_angle } -> std::convertible_to<Eigen::Vector3<Scalar>>;
  { s.delta_velocity } -> std::convertible_to<Eigen::Vector3<Scalar>>;
};

}  // namespace detail

}  // namespace splinertia
