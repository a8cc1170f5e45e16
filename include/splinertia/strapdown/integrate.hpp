// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <ranges>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/message.hpp>
#include <splinertia/strapdown/nav_state.hpp>
#include <stdexcept>
#include <vector>

namespace splinertia {

/// Anything with a time and the point samples of both sensors: gyro in rad/s, accel (specific force) in m/s².
template <typename S, typename Scalar, typename Time>
concept ImuSample = requires(const S& s) {
  { s.time } -> std::convertible_to<Time>;
  { s.gyro } -> std::convertible_to<Vector3<Scalar>>;
  { s.accel } -> std::convertible_to<Vector3<Scalar>>;
};

/// Integrates the samples of an IMU from `initial` on, in the inertial frame W with the acceleration of free fall
/// `gravity` (m/s²). Scheme is Euler, Midpoint or any type with
///
///   static NavState step(const NavState& state, const Sample& from, const Sample& to, const Vector3& gravity)
///
/// Returns one state for each sample, the first of them `initial`; none for no samples. Intervals may differ.
/// Throws std::invalid_argument where the first sample is not at initial.time, or where stamps do not increase.
template <typename Scheme, typename Scalar, TimePoint Time, std::ranges::input_range Samples>
  requires ImuSample<std::ranges::range_value_t<Samples>, Scalar, Time>
[[nodiscard]] std::vector<NavState<Scalar, Time>> integrate(
    const NavState<Scalar, Time>& initial, Samples&& samples,
    const Vector3<std::type_identity_t<Scalar>>& gravity = standard_gravity<Scalar>()) {
  std::vector<NavState<Scalar, Time>> states;
  if constexpr (requires { std::ranges::size(samples); }) states.reserve(std::ranges::size(samples));
  auto sample = std::ranges::begin(samples);
  const auto end = std::ranges::end(samples);
  if (sample == end) return states;
  std::ranges::range_value_t<Samples> previous = *sample;
  if (!(previous.time == initial.time)) {
    throw std::invalid_argument(message("integrate: the first sample is at ", printable(previous.time),
                                        ", the initial state at ", printable(initial.time)));
  }
  states.push_back(initial);
  for (++sample; sample != end; ++sample) {
    const auto& next = *sample;
    if (!(next.time > previous.time)) {
      throw std::invalid_argument(message("integrate: sample ", states.size(), " is at ", printable(next.time),
                                          ", expected a time after ", printable(previous.time)));
    }
    states.push_back(Scheme::step(states.back(), previous, next, gravity));
    previous = next;
  }
  return states;
}

}  // namespace splinertia
