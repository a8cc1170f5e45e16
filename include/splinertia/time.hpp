// SPDX-License-Identifier: MIT
/// Time is `double` (or another floating-point type), in seconds, or an integer std::chrono::duration since an epoch.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <chrono>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <ratio>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

template <typename T>
inline constexpr bool is_integer_duration = false;
template <typename Rep, typename Period>
inline constexpr bool is_integer_duration<std::chrono::duration<Rep, Period>> = std::signed_integral<Rep>;

}  // namespace detail

template <typename T>
concept TimePoint = std::floating_point<T> || detail::is_integer_duration<T>;

namespace detail {

/// Has a member `time` in seconds or as an integer duration.
template <typename T>
concept WithTime = requires(const T& t) { requires TimePoint<std::remove_cvref_t<decltype(t.time)>>; };

/// The type of that member.
template <WithTime T>
using TimeOf = std::remove_cvref_t<decltype(std::declval<const T&>().time)>;

/// Times and their differences. The difference between the ends of an integer Time needs its unsigned type.
template <typename T>
inline constexpr bool is_time_difference = TimePoint<T>;
template <std::unsigned_integral Rep, typename Period>
inline constexpr bool is_time_difference<std::chrono::duration<Rep, Period>> = true;

}  // namespace detail

/// A time difference in seconds. Take the difference in the type of time, so that stamps since an epoch lose no
/// precision.
template <typename Scalar = double, typename Time>
  requires detail::is_time_difference<Time>
[[nodiscard]] constexpr Scalar to_seconds(Time difference) {
  if constexpr (std::floating_point<Time>) {
    return static_cast<Scalar>(difference);
  } else {
    return std::chrono::duration_cast<std::chrono::duration<Scalar>>(difference).count();
  }
}

namespace detail {

/// The number to print: seconds, or ticks of an integer duration.
template <TimePoint Time>
[[nodiscard]] constexpr auto seconds_or_ticks(Time t) {
  if constexpr (std::floating_point<Time>) {
    return t;
  } else {
    return t.count();
  }
}

/// to − from. If an integer Time cannot hold the difference (64 bits of nanoseconds hold 292 years), the result is the
/// nearest value that it holds.
template <TimePoint Time>
[[nodiscard]] constexpr Time time_between(Time from, Time to) {
  if constexpr (std::floating_point<Time>) {
    return to - from;
  } else {
    typename Time::rep difference{};
    if (__builtin_sub_overflow(to.count(), from.count(), &difference)) [[unlikely]] {
      return difference < 0 ? (Time::max)() : (Time::min)();  // it has wrapped around
    }
    return Time(difference);
  }
}

/// to − from in the units of Time (seconds, or ticks of an integer duration), rounded once: the subtraction is done in
/// Time, or in Real if a floating-point Time has fewer digits. Requires that Time holds the difference.
template <typename Real, TimePoint Time>
[[nodiscard]] inline Real units_between(Time from, Time to) {
  if constexpr (!std::floating_point<Time>) {
    return static_cast<Real>((to - from).count());
  } else if constexpr (std::numeric_limits<Real>::digits > std::numeric_limits<Time>::digits) {
    return static_cast<Real>(to) - static_cast<Real>(from);
  } else {
    return static_cast<Real>(to - from);
  }
}

template <TimePoint Time>
inline constexpr int time_bits = std::numeric_limits<typename Time::rep>::digits + 1;

template <TimePoint Time, typename... Parts>
[[noreturn]] void refuse_time(const Parts&... parts) {
  refuse<std::out_of_range>("time: ", parts..., " does not fit into ", time_bits<Time>, "-bit ticks of ",
                            to_seconds<double>(Time(1)), " s");
}
/// Throws std::invalid_argument unless Time holds last − first, and with it all differences of times from first to
/// last. The message begins with `whose` and names `what` (plural). Requires first <= last.
template <TimePoint Time>
void check_span(std::string_view whose, std::string_view what, Time first, Time last) {
  if constexpr (std::floating_point<Time>) {
    if (last - first <= (std::numeric_limits<Time>::max)()) return;
    refuse<std::invalid_argument>(whose, ": ", what, " from ", first, " to ", last,
                                  " span more seconds than their time type can represent");
  } else {
    if (first >= Time::zero() || last <= (Time::max)() + first) return;
    refuse<std::invalid_argument>(whose, ": ", what, " from ", seconds_or_ticks(first), " to ", seconds_or_ticks(last),
                                  " span more ticks than ", time_bits<Time>, " bits can count");
  }
}

/// `duration` (s) as the nearest number of ticks. Throws std::out_of_range for NaN and for what Time cannot hold.
template <TimePoint Time, std::floating_point Seconds>
  requires is_integer_duration<Time>
[[nodiscard]] Time to_ticks(Seconds duration) {
  using Ticks = std::chrono::duration<Seconds, typename Time::period>;
  const Seconds ticks = Ticks(std::chrono::duration<Seconds>(duration)).count();
  // 2^(bits − 1) − 1/2 is the smallest number that rounds to an integer out of range. If Seconds has too few digits for
  // it, the limit is 2^(bits − 1).
  constexpr Seconds limit =
      -static_cast<Seconds>((std::numeric_limits<typename Time::rep>::min)()) - Seconds(1) / Seconds(2);
  if (!is_finite(duration) || !(std::abs(ticks) < limit)) refuse_time<Time>(duration, " s");
  return Time(static_cast<typename Time::rep>(std::llround(ticks)));
}

}  // namespace detail

/// The time `elapsed` seconds after `start`, to the nearest tick. Throws std::out_of_range if an integer Time cannot
/// hold it.
template <TimePoint Time>
[[nodiscard]] Time after(Time start, double elapsed) {
  if constexpr (std::floating_point<Time>) {
    return start + static_cast<Time>(elapsed);
  } else {
    typename Time::rep sum{};
    if (__builtin_add_overflow(start.count(), detail::to_ticks<Time>(elapsed).count(), &sum)) {
      detail::refuse_time<Time>(elapsed, " s after ", detail::seconds_or_ticks(start));
    }
    return Time(sum);
  }
}

namespace detail {

/// The first time after t: the next number, or the next tick. The largest time is its own next.
template <TimePoint Time>
[[nodiscard]] Time next_time(Time t) {
  if constexpr (std::floating_point<Time>) {
    return std::nextafter(t, (std::numeric_limits<Time>::max)());
  } else {
    return t < (Time::max)() ? t + Time(1) : t;
  }
}

/// The same time in another type. Seconds are rounded to the nearest tick, finer ticks towards zero. Today's seconds
/// since 1970 are good to a quarter of a microsecond as double. Throws std::out_of_range if Time cannot hold it.
template <TimePoint Time, TimePoint From>
[[nodiscard]] Time as_time(From t) {
  if constexpr (std::same_as<Time, From>) {
    return t;
  } else if constexpr (std::floating_point<Time>) {
    return to_seconds<Time>(t);
  } else if constexpr (std::floating_point<From>) {
    return to_ticks<Time>(t);
  } else {
    using Factor = std::ratio_divide<typename From::period, typename Time::period>;
    std::intmax_t scaled{};
    typename Time::rep ticks{};
    if (__builtin_mul_overflow(t.count(), Factor::num, &scaled) ||
        __builtin_add_overflow(scaled / Factor::den, 0, &ticks)) {
      refuse_time<Time>(to_seconds<double>(t), " s");
    }
    return Time(ticks);
  }
}

}  // namespace detail

/// The same time in nanoseconds, the unit of the field's file formats. Seconds are rounded to the nearest nanosecond.
/// Throws std::out_of_range beyond 292 years, which is what 64 bits hold.
template <TimePoint Time>
[[nodiscard]] std::chrono::nanoseconds to_nanoseconds(Time t) {
  return detail::as_time<std::chrono::nanoseconds>(t);
}

}  // namespace splinertia
