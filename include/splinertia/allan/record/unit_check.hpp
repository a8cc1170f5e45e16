// SPDX-License-Identifier: MIT
/// Checks of the units of a static log. No estimate shows a wrong unit: all are off by the same factor.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <splinertia/detail/require.hpp>
#include <splinertia/units.hpp>

namespace splinertia::allan {

/// What the mean of a static accelerometer suggests.
enum class AccelerometerMean {
  gravity,             ///< in m/s², within 5 %
  gravity_in_g,        ///< within 5 % of 1
  gravity_in_milli_g,  ///< or in cm/s², which differs by 2 %, no more than a bias
  no_gravity,          ///< below 5 % of g: gravity was removed (not the reading of a sensor), or free fall
  unclear              ///< moving, not calibrated, or in counts
};

/// Judges the mean of all three axes. Its norm is g, 9.78 to 9.83 m/s² on Earth, plus a bias, for which the limits
/// leave 5 %.
[[nodiscard]] inline AccelerometerMean recognize_accelerometer_mean(const Eigen::Vector3d& mean) {
  const double norm = mean.norm();
  const auto nearby = [norm](double value) { return std::abs(norm / value - 1) <= 0.05; };
  if (nearby(units::standard_g)) return AccelerometerMean::gravity;
  if (nearby(1)) return AccelerometerMean::gravity_in_g;
  if (nearby(1000) || nearby(100 * units::standard_g)) return AccelerometerMean::gravity_in_milli_g;
  return norm < 0.05 * units::standard_g ? AccelerometerMean::no_gravity : AccelerometerMean::unclear;
}

/// Whether a static gyroscope can have this mean in rad/s: biases are below 1 rad/s = 57 °/s, those of the cheapest
/// sensors below 20 °/s. A larger mean is that of a turning body, or in °/s or °/h. A smaller one proves nothing: most
/// logs in °/s pass, too.
[[nodiscard]] inline bool plausible_gyroscope_mean(const Eigen::Vector3d& mean) { return mean.norm() < 1; }

/// What a white noise N says about its unit.
enum class WhiteNoiseCheck {
  plausible,
  too_small,  ///< below the best sensors there are: in a larger unit (g), simulated, or filtered
  too_large   ///< above the worst: in a smaller unit (°/s, °/h, mg), in counts, or not at rest
};

/// Whether a gyroscope can have this N in rad/s/√Hz: 5e-8 to 3e-2 (1.7e-4 to 103 °/√h). The range is from below
/// navigation grade to seven times the noise of a MEMS sensor for 20000 °/s (0.25 °/s/√Hz, Analog Devices' ADXRS649). A
/// log in °/s has 57 times as much, which is found for a noisy sensor but not for a quiet one. Throws
/// std::invalid_argument unless N is finite and >= 0.
[[nodiscard]] inline WhiteNoiseCheck check_gyroscope_white_noise(double N) {
  splinertia::detail::require_non_negative("check_gyroscope_white_noise", "N", N);
  if (N < 5e-8) return WhiteNoiseCheck::too_small;
  return N > 3e-2 ? WhiteNoiseCheck::too_large : WhiteNoiseCheck::plausible;
}

/// Whether an accelerometer can have this N in m/s²/√Hz: 1e-7 to 0.2 (0.01 µg/√Hz to 20 mg/√Hz). The range includes
/// seismometers below and shock sensors above. The mean shows a unit of g or mg, see recognize_accelerometer_mean().
/// Throws std::invalid_argument unless N is finite and >= 0.
[[nodiscard]] inline WhiteNoiseCheck check_accelerometer_white_noise(double N) {
  splinertia::detail::require_non_negative("check_accelerometer_white_noise", "N", N);
  if (N < 1e-7) return WhiteNoiseCheck::too_small;
  return N > 0.2 ? WhiteNoiseCheck::too_large : WhiteNoiseCheck::plausible;
}

}  // namespace splinertia::allan
