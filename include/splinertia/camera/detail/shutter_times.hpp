// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <splinertia/camera/shutter.hpp>
#include <splinertia/time.hpp>

namespace splinertia::detail {

/// offset s after a time: the nearest Time, and what rounding to it left over.
template <typename Scalar, TimePoint Time>
struct RoundedTime {
  Time time;
  Scalar rest;  ///< s: the exact time is `time` + rest
};

template <typename Scalar, TimePoint Time>
[[nodiscard]] inline RoundedTime<Scalar, Time> rounded_after(Time start, const Scalar& offset) {
  if constexpr (std::floating_point<Time>) {
    const Time t = start + static_cast<Time>(offset);
    return {t, offset - static_cast<Scalar>(t - start)};
  } else {
    const Time ticks = to_ticks<Time>(offset);
    return {start + ticks, offset - to_seconds<Scalar>(ticks)};
  }
}

/// When the rows of one frame are read. Offsets are seconds after the time of the frame.
template <typename Scalar>
struct ShutterTimes {
  Scalar stamp_row, stamp_seconds, line_delay;

  template <typename Delay, typename Stamp>
  ShutterTimes(const RollingShutter<Delay, Stamp>& shutter, int height)
      : line_delay(static_cast<Scalar>(shutter.line_delay)) {
    const auto stamp = stamp_offset<Scalar>(shutter.stamp, line_delay, height);
    stamp_row = stamp.rows;
    stamp_seconds = stamp.seconds;
  }
  [[nodiscard]] Scalar offset(const Scalar& row) const { return (row - stamp_row) * line_delay + stamp_seconds; }
};

}  // namespace splinertia::detail
