// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/per_axis.hpp>

namespace splinertia {

/// A sample of one sensor as it passes through the error terms. `Axes` numbers are measured at a time: 3 by a gyroscope,
/// 1 by a barometer. Terms that need more than this take a derived type (imu/imu_sensor_sample.hpp).
template <typename Scalar, int Axes = 3>
struct SensorSample {
  static constexpr int axes = detail::checked_axes<Axes>();

  AxisVector<Scalar, axes> value;  ///< the reading so far; the true one before the first term
  AxisVector<Scalar, axes> bias;   ///< the bias in `value` so far
  Scalar interval;                 ///< since the previous sample, s; the sampling interval for the first
  bool first;                      ///< whether it is the first of its run
  Scalar elapsed;                  ///< since the first sample, s
};

}  // namespace splinertia
