// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/time.hpp>

#include <cmath>
#include <limits>

namespace splinertia {

/// The time stamp of a sample on its way through the error terms of a clock, as Sample is for a sensor: what the host
/// makes of the time at which the sample was taken.
template <typename Scalar>
struct Stamp {
  Scalar offset;    ///< of the stamp from the true time so far, s
  bool dropped;     ///< whether the sample has been lost
  Scalar interval;  ///< true time since the previous sample, s; the sampling interval for the first
  bool first;       ///< whether it is the first of its run
  Scalar elapsed;   ///< true time since the first sample, s
};

/// The earliest stamp that a clock gives after another: a tick later, or of seconds a nanosecond, the unit of the
/// field's files, as far as a number of that size resolves it. To nanoseconds the two are rounded differently.
template <TimePoint Time>
[[nodiscard]] Time next_stamp(Time stamp) {
  if constexpr (std::floating_point<Time>) {
    // A quarter more than a nanosecond and four units in the last place: what rounding can take away.
    return stamp + (Time(5) / Time(4'000'000'000) + Time(4) * std::numeric_limits<Time>::epsilon() * std::abs(stamp));
  } else {
    return next_time(stamp);
  }
}

}  // namespace splinertia
