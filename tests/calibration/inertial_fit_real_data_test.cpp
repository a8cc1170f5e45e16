// SPDX-License-Identifier: MIT
// Real data: euroc_MH_05_pair/imu0.txt euroc_MH_05_pair/gt.csv
// An IMU of EuRoC (MH_05) along its ground truth.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <splinertia/calibration/inertial_fit.hpp>
#include <splinertia/io/euroc.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

using Curve = Spline<SO3xR3<double>, 4, UniformKnots<std::chrono::nanoseconds>>;

/// Degrees between gravity and the vertical of the world.
double tilt(const ImuCalibration<double>& calibration) {
  return std::acos(-calibration.gravity.normalized().z()) * 180 / std::acos(-1.0);
}

}  // namespace

TEST_CASE("What the filter of EuRoC has estimated of the IMU is found along its trajectory", "[.real_data]") {
  const auto folder = std::filesystem::path(SPLINERTIA_TEST_DATA) / "euroc_MH_05_pair";
  const auto states = read_euroc_groundtruth(folder / "gt.csv");
  const auto samples = read_euroc_imu(folder / "imu0.txt");
  std::vector<Stamped<SO3xR3<double>>> poses;
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero(), accel_bias = Eigen::Vector3d::Zero();
  for (const auto& state : states) {
    poses.push_back({state.time, state.value});
    gyro_bias += state.gyro_bias / static_cast<double>(states.size());
    accel_bias += state.accel_bias / static_cast<double>(states.size());
  }
  // At 0.02 s between knots, the curve follows the jumps of the positions as well as it can: the accelerometer is off
  // it by 2.4 m/s² (RMS).
  InertialOptions<double> options{.gyro_standard_deviation = 0.03, .accel_standard_deviation = 2.4};
  const auto alone = fit<Curve>(poses, {.knot_interval = 0.02, .loss = RobustLoss::huber()});
  const auto held = calibrate_imu(alone.spline, samples, options);
  CHECK(held.converged);
  CHECK(held.samples > 22000);
  INFO("gyro bias " << held.calibration.gyro_bias.transpose() << ", the filter's " << gyro_bias.transpose());
  INFO("accel bias " << held.calibration.accel_bias.transpose() << ", the filter's " << accel_bias.transpose());
  CHECK((held.calibration.gyro_bias - gyro_bias).cwiseAbs().maxCoeff() < 2e-5);     // it is 5e-6
  CHECK((held.calibration.accel_bias - accel_bias).cwiseAbs().maxCoeff() < 0.005);  // it is 0.0013
  CHECK(held.gyro_rms < 0.03);
  CHECK(tilt(held.calibration) < 0.05);

  // The filter took the IMU for the body frame, and its clock for the time.
  options.estimate_lever_arm = options.estimate_time_offset = true;
  const auto all = calibrate_imu(alone.spline, samples, options);
  CHECK(all.converged);
  INFO("lever arm " << all.calibration.mounting.p_BI.transpose() << " m, time offset " << all.calibration.time_offset
                    << " s");
  CHECK(all.calibration.mounting.p_BI.norm() < 0.03);
  CHECK(std::abs(all.calibration.time_offset) < 0.002);

  // Both together, over 15 s in flight: the curve agrees with the accelerometer far better, and still with the poses.
  const auto first = poses.begin() + 8000;
  const std::vector<Stamped<SO3xR3<double>>> part(first, first + 3000);
  const Tangent<SO3xR3<double>> deviation = Tangent<SO3xR3<double>>::Constant(0.003);
  options = {.gyro_standard_deviation = 0.03, .accel_standard_deviation = 0.5};
  const auto both = inertial_fit<Curve>(
      part, samples, {.knot_interval = 0.02, .standard_deviation = deviation, .loss = RobustLoss::huber()}, options);
  CHECK(both.converged);
  const auto held_part =
      calibrate_imu(fit<Curve>(part, {.knot_interval = 0.02, .loss = RobustLoss::huber()}).spline, samples, options);
  INFO("accelerometer " << held_part.accel_rms << " m/s² off the poses' curve, " << both.imu.accel_rms
                        << " off both's");
  INFO("poses " << both.residuals.component_rms.transpose() << " rad, m off it");
  INFO("gyro bias " << both.imu.calibration.gyro_bias.transpose() << " accel bias "
                    << both.imu.calibration.accel_bias.transpose());
  CHECK(both.imu.accel_rms < held_part.accel_rms / 2);
  CHECK(both.residuals.component_rms.maxCoeff() < 0.003);
  CHECK((both.imu.calibration.gyro_bias - gyro_bias).cwiseAbs().maxCoeff() < 1e-3);  // biases of these 15 s alone
  CHECK((both.imu.calibration.accel_bias - accel_bias).cwiseAbs().maxCoeff() < 0.05);
}
