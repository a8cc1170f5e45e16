// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>

namespace splinertia {

/// Times at a constant interval: sample i is at start + i·interval. This is rounded once with FMA and twice without.
template <TimePoint T = double>
struct SampleTimes {
  using Time = T;

  Time start;     ///< of sample 0; s for a floating-point Time
  Time interval;  ///< > 0

  [[nodiscard]] Time operator()(std::size_t i) const {
    if constexpr (std::floating_point<Time>) {
      return start + static_cast<Time>(i) * interval;
    } else {
      // Unsigned: evaluate_packed() also computes times after the last sample, which may overflow Time.
      const auto ticks = [](auto x) { return static_cast<std::uintmax_t>(x); };
      return Time(static_cast<typename Time::rep>(ticks(start.count()) + ticks(i) * ticks(interval.count())));
    }
  }

  /// The times of samples i, i + 1, … in one SIMD pack. Time is double.
  template <typename L>
  [[nodiscard]] L lanes(std::size_t i) const
    requires std::same_as<Time, double>
  {
    return L(start) + (L(static_cast<double>(i)) + L::ramp()) * L(interval);
  }

  /// duration / interval, approximately.
  [[nodiscard]] double intervals(Time duration) const {
    if constexpr (std::floating_point<Time>) {
      return static_cast<double>(duration / interval);
    } else {
      return static_cast<double>(duration.count()) / static_cast<double>(interval.count());
    }
  }
};

template <typename T>
SampleTimes(T, T) -> SampleTimes<T>;

namespace detail {

/// Throws std::invalid_argument unless the interval is positive and finite, and std::out_of_range unless the first
/// `count` times are in [start, end]. The last may exceed `end` by rounding.
template <TimePoint Time>
inline void check_sample_times(const SampleTimes<Time>& times, std::size_t count, Time start, Time end) {
  if (!(times.interval > Time{}) || !is_finite(times.interval)) {
    refuse<std::invalid_argument>("sample: interval is ", seconds_or_ticks(times.interval),
                                  ", expected a positive finite number");
  }
  if (count == 0) return;
  if constexpr (!std::floating_point<Time>) {
    if (count - 1 > static_cast<std::size_t>(time_between(times.start, (Time::max)()) / times.interval)) {
      refuse<std::out_of_range>("sample: ", count, " samples ", seconds_or_ticks(times.interval),
                                " apart, starting at ", seconds_or_ticks(times.start),
                                ", exceed the largest representable time");
    }
  }
  const Time last = times(count - 1);
  Time rounding{};
  if constexpr (std::floating_point<Time>) {
    rounding = 4 * std::numeric_limits<Time>::epsilon() * (std::max)(std::abs(times.start), std::abs(end));
  }
  if (!(is_finite(times.start) && times.start >= start && last >= times.start && last - rounding <= end)) {
    refuse<std::out_of_range>("sample: ", count, " samples from ", seconds_or_ticks(times.start), " to ",
                              seconds_or_ticks(last), ", the curve is defined from ", seconds_or_ticks(start), " to ",
                              seconds_or_ticks(end));
  }
}

}  // namespace detail

}  // namespace splinertia
