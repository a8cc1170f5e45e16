// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/units.hpp>

#include "support/fit_report.hpp"
#include "support/formatted.hpp"
#include "support/yaml_text.hpp"

using namespace splinertia;

namespace {

/// A number with its standard deviation.
std::string estimate(double value, double deviation) {
  if (!std::isfinite(deviation)) return formatted("%11.5g  not shown  ", value);
  return formatted("%11.5g +- %-8.2g", value, deviation);
}

}  // namespace

std::string imu_report(const FittedImu& fitted, const FitImu& imu) {
  const auto& [calibration, deviation, gyro_rms, accel_rms, inside, iterations, converged] = fitted.calibrated;
  std::string text = formatted("\nIMU %s: %zu of %zu samples within the curve and outside holes, %s\n",
                               escaped_line(imu.file.string()).c_str(), inside, imu.samples.size(),
                               imu.fit_together ? "fitted together with the poses" : "compared with the curve");
  const auto row = [&](const char* name, const Eigen::Vector3d& value, const Eigen::Vector3d& sigma, const char* unit) {
    text += formatted("  %-19s", name);
    for (int i = 0; i < 3; ++i) text += estimate(value[i], sigma[i]);
    text += formatted(" %s\n", unit);
  };
  row("gyroscope bias", calibration.gyro_bias, deviation.gyro_bias, "rad/s");
  row("accelerometer bias", calibration.accel_bias, deviation.accel_bias, "m/s^2");
  if (imu.estimate_lever_arm) row("lever arm", calibration.mounting.p_BI, deviation.lever_arm, "m");
  if (imu.estimate_time_offset) {
    text += formatted("  %-19s%s s, trajectory's clock minus IMU's clock\n", "time offset",
                      estimate(calibration.time_offset, deviation.time_offset).c_str());
  }
  const Eigen::Vector3d given = imu.gravity, &found = calibration.gravity;
  const double turned = std::atan2(given.cross(found).norm(), given.dot(found));
  text += formatted("  %-19s%11.5g %11.5g %11.5g m/s^2: %.3g deg +- %.2g deg from the given direction\n", "gravity",
                    found.x(), found.y(), found.z(), turned / units::degree,
                    deviation.gravity_direction.maxCoeff() / units::degree);
  text += formatted("  %-19s%11.4g rad/s, %.4g m/s^2 (rms of each axis)\n", "residuals", gyro_rms, accel_rms);
  text +=
      formatted("  +- one sigma, with white noise of %.4g rad/s and %.4g m/s^2 in a sample, as %s\n",
                fitted.gyro_deviation, fitted.accel_deviation, imu.gyro_deviation ? "given" : "found in the residuals");
  if (!imu.fit_together) text += "  the curve's own error is not white and not included: see --fit-imu\n";
  if (imu.fit_together && (gyro_rms > 2 * fitted.gyro_deviation || accel_rms > 2 * fitted.accel_deviation)) {
    text +=
        "  warning: the residuals are more than twice the deviations given: the knots are too far apart for the IMU "
        "(--knot-interval), or the deviations too small\n";
  }
  if (!converged) text += formatted("  NOT CONVERGED after %d linear systems\n", iterations);
  return text;
}
