// SPDX-License-Identifier: MIT
/// What a static log gives away of the units it is in, which no estimate would: they are all off by the same factor.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <splinertia/detail/require.hpp>
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
  const auto nearby = [norm](double value) { return std::abs(norm / value - 1) <= 0.05; };
  if (nearby(units::standard_g)) return AccelerometerMean::gravity;
  if (nearby(1)) return AccelerometerMean::gravity_in_g;
  if (nearby(1000) || nearby(100 * units::standard_g)) return AccelerometerMean::gravity_in_milli_g;
  return norm < 0.05 * units::standard_g ? AccelerometerMean::no_gravity : AccelerometerMean::unclear;
}

/// Whether a static gyroscope can have this mean in rad/s: biases are below 1 rad/s = 57 °/s, those of the cheapest
/// sensors below 20 °/s. A larger one is of a body that turns, or in °/s or °/h. A smaller one proves nothing: most
/// logs in °/s have it, too.
[[nodiscard]] inline bool plausible_gyroscope_mean(const Eigen::Vector3d& mean) { return mean.norm() < 1; }

/// What a white noise N says of the unit it is in.
enum class WhiteNoiseCheck {
  plausible,
  too_small,  ///< below the best sensors there are: in a larger unit (g), simulated, or filtered
  too_large   ///< above the worst: in a smaller unit (°/s, °/h, mg), in counts, or not at rest
};

/// Whether a gyroscope can have this N in rad/s/√Hz: 5e-8 to 3e-2 (1.7e-4 to 103 °/√h), from below those of navigation
/// grade to seven times the noise of a MEMS sensor for 20000 °/s (0.25 °/s/√Hz, Analog Devices' ADXRS649). A noisy
/// sensor's log in °/s, 57 times as much, is found, a quiet one's is not. Throws std::invalid_argument unless N is
/// finite and >= 0.
[[nodiscard]] inline WhiteNoiseCheck check_gyroscope_white_noise(double N) {
  require_non_negative("check_gyroscope_white_noise", "N", N);
  if (N < 5e-8) return WhiteNoiseCheck::too_small;
  return N > 3e-2 ? WhiteNoiseCheck::too_large : WhiteNoiseCheck::plausible;
}

/// Whether an accelerometer can have this N in m/s²/√Hz: 1e-7 to 0.2 (0.01 µg/√Hz to 20 mg/√Hz), generous to
/// seismometers below and to sensors of shocks above. A unit that is g or mg shows in the mean, see
/// recognize_accelerometer_mean(). Throws std::invalid_argument unless N is finite and >= 0.
[[nodiscard]] inline WhiteNoiseCheck check_accelerometer_white_noise(double N) {
  require_non_negative("check_accelerometer_white_noise", "N", N);
  if (N < 1e-7) return WhiteNoiseCheck::too_small;
  return N > 0.2 ? WhiteNoiseCheck::too_large : WhiteNoiseCheck::plausible;
}

}  // namespace splinertia::allan
