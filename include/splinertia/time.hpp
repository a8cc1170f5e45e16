// SPDX-License-Identifier: MIT
/// Time is `double` (or another floating-point type), in seconds, or an integer std::chrono::duration since an epoch.
#pragma once

#include <splinertia/cpp20.hpp>

#include <chrono>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

namespace splinertia {

template <typename T>
inline constexpr bool is_integer_duration = false;
template <typename Rep, typename Period>
inline constexpr bool is_integer_duration<std::chrono::duration<Rep, Period>> = std::integral<Rep>;

template <typename T>
concept TimePoint = std::floating_point<T> || is_integer_duration<T>;

/// A time difference in seconds. Differences are taken in the type of time, so that epoch stamps lose nothing.
template <typename Scalar, TimePoint Time>
[[nodiscard]] constexpr Scalar to_seconds(Time difference) {
  if constexpr (std::floating_point<Time>) {
    return static_cast<Scalar>(difference);
  } else {
    return std::chrono::duration_cast<std::chrono::duration<Scalar>>(difference).count();
  }
}

/// The time that is `elapsed` seconds after `start`, to the nearest tick.
template <TimePoint Time>
[[nodiscard]] Time after(Time start, double elapsed) {
  if constexpr (std::floating_point<Time>) {
    return start + static_cast<Time>(elapsed);
  } else {
    using Ticks = std::chrono::duration<double, typename Time::period>;
    return start + Time(std::llround(Ticks(std::chrono::duration<double>(elapsed)).count()));
  }
}

/// The time right after t: the next number, or the next tick.
template <TimePoint Time>
[[nodiscard]] Time next_time(Time t) {
  if constexpr (std::floating_point<Time>) {
    return std::nextafter(t, std::numeric_limits<Time>::max());
  } else {
    return t + Time(1);
  }
}

/// The same time in nanoseconds, as files of the field keep it; seconds are rounded to the nearest.
template <TimePoint Time>
[[nodiscard]] std::chrono::nanoseconds to_nanoseconds(Time t) {
  if constexpr (std::floating_point<Time>) {
    return after(std::chrono::nanoseconds{0}, static_cast<double>(t));
  } else {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(t);
  }
}

/// What to print: seconds, or ticks of an integer duration.
template <TimePoint Time>
[[nodiscard]] constexpr auto printable(Time t) {
  if constexpr (std::floating_point<Time>) {
    return t;
  } else {
    return t.count();
  }
}

}  // namespace splinertia
