// SPDX-License-Identifier: MIT
/// Stand-ins for samples whose scalar and number of axes are unknown, to ask whether a function takes samples.
#pragma once

#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/sensor_sample.hpp>

namespace splinertia::detail {

template <typename Scalar, int Axes>
void take_sensor_sample(SensorSample<Scalar, Axes>& sample);
template <typename Scalar>
void take_stamp(Stamp<Scalar>& stamp);

/// A SensorSample of any scalar and number of axes, or a type derived from one; likewise a Stamp.
template <typename S>
concept SensorSampleType = requires(S& sample) { take_sensor_sample(sample); };
template <typename S>
concept StampType = requires(S& stamp) { take_stamp(stamp); };

/// These convert to whichever sample a function asks for: to a reference that the function can write to, or to a copy.
struct AnySensorSample {
  static constexpr int axes = 3;
  template <SensorSampleType S>
  operator S&() const;
};
struct AnySensorSampleCopy {
  template <SensorSampleType S>
  operator S() const;
};
struct AnyStamp {
  static constexpr int axes = Stamp<double>::axes;
  template <StampType S>
  operator S&() const;
};
struct AnyStampCopy {
  template <StampType S>
  operator S() const;
};

}  // namespace splinertia::detail
