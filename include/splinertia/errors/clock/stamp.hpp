// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/time.hpp>

#include <cmath>
#include <limits>

namespace splinertia {

/// The time stamp of a sample as it passes through the error terms of a clock, as SensorSample does for a sensor. The
/// terms turn the time at which the sample was taken into the time that the host records.
template <typename Scalar>
struct Stamp {
  static constexpr int axes = 1;  ///< the terms of a clock draw one number at a time

  Scalar offset;    ///< stamp minus true time so far, s
  bool dropped;     ///< whether the sample has been lost
  Scalar interval;  ///< true time since the previous sample, s; the sampling interval for the first
  bool first;       ///< whether it is the first of its run
  Scalar elapsed;   ///< true time since the first sample, s
};

namespace detail {

/// The earliest stamp that a clock gives after `stamp`: one tick later. For a floating-point Time it is a nanosecond
/// later, the unit of the field's file formats, or as little as a number of that size resolves. Rounded to nanoseconds,
/// the two still differ.
template <TimePoint Time>
[[nodiscard]] Time next_stamp(Time stamp) {
  if constexpr (std::floating_point<Time>) {
    // A nanosecond, and what rounding can take away: a quarter of a nanosecond and four units in the last place.
    return stamp + (Time(5) / Time(4'000'000'000) + Time(4) * std::numeric_limits<Time>::epsilon() * std::abs(stamp));
  } else {
    return next_time(stamp);
  }
}

}  // namespace detail

}  // namespace splinertia
