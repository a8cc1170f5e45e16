// SPDX-License-Identifier: MIT
#include "support/imu_log_checks.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <splinertia/allan/record/unit_check.hpp>
#include <splinertia/errors/error_term.hpp>
#include <stdexcept>

#include "support/concat.hpp"
#include "support/formatted.hpp"

using namespace splinertia;

namespace {

/// The mean of each axis, if the log has all three.
std::optional<Eigen::Vector3d> mean_of(const SensorLog& sensor) {
  if (sensor.axes.size() != 3) return std::nullopt;
  Eigen::Vector3d mean;
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (const double value : sensor.axes[i].values) sum += value;
    mean[static_cast<Eigen::Index>(i)] = sum / static_cast<double>(sensor.axes[i].values.size());
  }
  return mean;
}

/// A number with 4 digits.
std::string short_text(double value) { return formatted("%.4g", value); }

}  // namespace

void check_unit(const SensorLog& sensor, bool given, ImuLog& log) {
  log.units += concat(log.units.empty() ? "" : ", ", sensor_name(sensor.kind), " in ",
                      unit_text(SensorUnit{}, sensor.kind), given ? " as converted" : " as assumed");
  const auto mean = mean_of(sensor);
  if (!mean) return;
  log.units += concat(" (mean ", short_text(mean->norm()), ")");
  const auto say = [&](bool refuse, const std::string& text) {
    if (refuse && !given) throw std::runtime_error(text);
    log.warnings.push_back(text);
  };
  if (sensor.kind == SensorKind::gyro) {
    if (allan::plausible_gyroscope_mean(*mean)) return;
    say(true, concat("gyroscope: its mean is ", short_text(mean->norm()),
                     " rad/s, expected less than 1 at rest: it turns, or give --gyro-unit deg/s (or rad/s, if that is "
                     "right)"));
    return;
  }
  using allan::AccelerometerMean;
  const std::string found =
      concat("accelerometer: its mean is ", short_text(mean->norm()), " m/s^2, expected 9.8 at rest: ");
  const char* or_si = " (or m/s2, if that is right)";
  switch (allan::recognize_accelerometer_mean(*mean)) {
    case AccelerometerMean::gravity:
      break;
    case AccelerometerMean::gravity_in_g:
      say(true, concat(found, "it looks like g, give --accel-unit g", or_si));
      break;
    case AccelerometerMean::gravity_in_milli_g:
      say(true, concat(found, "it looks like mg, give --accel-unit mg", or_si));
      break;
    case AccelerometerMean::no_gravity:
      say(false, concat(found, "gravity has been removed, perhaps by a filter, which also changes the noise"));
      break;
    case AccelerometerMean::unclear:
      say(false, concat(found, "it moves, is not calibrated, or is in another unit"));
      break;
  }
}
