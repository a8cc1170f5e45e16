// SPDX-License-Identifier: MIT
/// Checks whether a type is a scheme and which samples it takes, so that a mistake gives one clear compiler error.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/strapdown/detail/sample_window.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>
#include <splinertia/time.hpp>

namespace splinertia {

namespace detail {

/// The window of samples that is passed to a scheme.
template <typename Scheme, typename Scalar, typename Time>
using SchemeWindow = std::array<typename SampleWindow<Scheme, Scalar, Time>::Sample, Scheme::window>;

/// Has the constants of PointScheme or IncrementScheme, from which schemes derive.
template <typename Scheme>
concept PointOrIncrementScheme = requires {
  { Scheme::takes_increments } -> std::convertible_to<bool>;
  { Scheme::needs_equal_intervals } -> std::convertible_to<bool>;
  { Scheme::window } -> std::convertible_to<std::size_t>;
  { Scheme::stride } -> std::convertible_to<std::size_t>;
  { Scheme::lead } -> std::convertible_to<std::size_t>;
};

}  // namespace detail

/// A scheme: also has moments() or increment() as described in scheme.hpp.
template <typename Scheme, typename Scalar, typename Time>
concept IntegrationScheme = detail::PointOrIncrementScheme<Scheme> &&
                            (detail::HasMoments<Scheme, Scalar, detail::SchemeWindow<Scheme, Scalar, Time>> ||
                             detail::HasIncrement<Scheme, Scalar, detail::SchemeWindow<Scheme, Scalar, Time>>);

namespace detail {

/// Whether S is what the scheme takes: point samples or increments.
template <typename S, typename Scheme, typename Scalar, typename Time>
concept SampleFor = (Scheme::takes_increments && ImuIncrementOf<S, Scalar, Time>) ||
                    (!Scheme::takes_increments && ImuSampleOf<S, Scalar, Time>);

/// Whether a scheme takes samples of type S. If not, a static_assert says what it expects.
template <typename Scheme, typename Scalar, typename Time, typename S>
constexpr bool check_sample() {
  constexpr bool good = SampleFor<S, Scheme, Scalar, Time>;
  constexpr bool timed = HasTime<S, Time> || !requires(const S& s) { s.time; };
  static_assert(timed,
                "the samples must have the same type of time as the integration: double (seconds) or the same "
                "std::chrono::duration (wrap integer stamps in a duration)");
  static_assert(
      good || !timed || Scheme::takes_increments,
      "this scheme takes point samples: structs with time, gyro (rad/s) and accel (m/s^2), both of them Eigen "
      "3-vectors of the integration's scalar");
  static_assert(good || !timed || !Scheme::takes_increments,
                "this scheme takes increments: structs with time, delta_angle (rad) and delta_velocity (m/s), both of "
                "them Eigen 3-vectors of the integration's scalar");
  return good;
}

}  // namespace detail

}  // namespace splinertia
