// SPDX-License-Identifier: MIT
/// What a static log gives away of the units it is in, which no estimate would: they are all off by the same factor.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <splinertia/units.hpp>

namespace splinertia::allan {

/// What the mean of a static accelerometer looks like.
enum class AccelerometerMean {
  gravity,             ///< in m/s², within 5 %
  gravity_in_g,        ///< within 5 % of 1
  gravity_in_milli_g,  ///< or in cm/s², which is 2 % off: as much as a bias
  no_gravity,  ///< below 5 % of a g: as if gravity had been taken out (not the reading of a sensor), or free fall
  unclear      ///< moving, not calibrated, or in counts
};

/// From the mean of all three axes: its norm is g, 9.78 to 9.83 m/s² on Earth, plus a bias, which 5 % leaves room for.
[[nodiscard]] inline AccelerometerMean recognize_accelerometer_mean(const Eigen::Vector3d& mean) {
  const double norm = mean.norm();
  const auto near = [norm](double value) { return std::abs(norm / value - 1) <= 0.05; };
  if (near(units::standard_g)) return AccelerometerMean::gravity;
  if (near(1)) return AccelerometerMean::gravity_in_g;
  if (near(1000) || near(100 * units::standard_g)) return AccelerometerMean::gravity_in_milli_g;
  return norm < 0.05 * units::standard_g ? AccelerometerMean::no_gravity : AccelerometerMean::unclear;
}

/// Whether a static gyroscope can have this mean in rad/s: biases are below 1 rad/s = 57 °/s, those of the cheapest
/// sensors below 20 °/s. A larger one is of a body that turns, or in °/s or °/h. A smaller one proves nothing: most
/// logs in °/s have it, too.
[[nodiscard]] inline bool plausible_gyroscope_mean(const Eigen::Vector3d& mean) { return mean.norm() < 1; }

}  // namespace splinertia::allan
