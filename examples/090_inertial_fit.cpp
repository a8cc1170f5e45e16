// SPDX-License-Identifier: MIT
// inertial_fit() fits a curve to poses and the samples of an IMU together. It estimates the biases of the IMU, and here
// also where it is mounted and how far its clock is off.

#include <cstdio>
#include <splinertia/calibration/inertial_fit.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/random/normal.hpp>
#include <vector>

using namespace splinertia;

int main() {
  ImuCalibration<double> truth;
  truth.gyro_bias << 0.01, -0.02, 0.03;  // rad/s
  truth.mounting.p_BI << 0.1, 0, 0;      // m
  truth.time_offset = 0.013;             // s

  // Poses at 20 Hz with a noise of 1 mrad and 1 mm. IMU at 200 Hz with 1 mrad/s and 10 mm/s^2 in a sample.
  NormalStream<> normal(StreamKey(1));
  const auto noise = [&](double deviation) {
    return Eigen::Vector3d{deviation * Eigen::Vector3d{normal(), normal(), normal()}};
  };
  std::vector<Stamped<SO3xR3<double>, double>> poses;
  std::vector<ImuSample<>> samples;
  for (int i = 0; i <= 4000; ++i) {
    const double t = 0.005 * i;
    const auto imu = predicted_imu(Ellipse<>{}.evaluate<2>(t + truth.time_offset), truth);
    samples.push_back({t, imu.gyro + noise(1e-3), imu.accel + noise(1e-2)});
    if (i % 10 != 0) continue;
    const auto pose = Ellipse<>{}.evaluate<0>(t).value;
    poses.push_back({t, {rotation(pose) * Sophus::SO3d::exp(noise(1e-3)), position(pose) + noise(1e-3)}});
  }

  InertialOptions<double> options{.gyro_standard_deviation = 1e-3, .accel_standard_deviation = 1e-2};
  options.estimate_lever_arm = options.estimate_time_offset = true;
  using Curve = Spline<SO3xR3<double>, 6>;
  const auto pose_deviation = Tangent<SO3xR3<double>>::Constant(1e-3);  // rad, m
  const auto fitted =
      inertial_fit<Curve>(poses, samples, {.knot_interval = 0.1, .standard_deviation = pose_deviation}, options);

  const auto& found = fitted.imu.calibration;
  const auto& deviation = fitted.imu.standard_deviation;
  std::printf("gyro bias y  %8.5f rad/s +- %.5f\n", found.gyro_bias.y(), deviation.gyro_bias.y());
  std::printf("lever arm x  %8.4f m +- %.4f\n", found.mounting.p_BI.x(), deviation.lever_arm.x());
  std::printf("time offset  %8.2f ms +- %.2f\n", 1e3 * found.time_offset, 1e3 * deviation.time_offset);
}

// prints
// gyro bias y  -0.01999 rad/s +- 0.00002
// lever arm x    0.0994 m +- 0.0015
// time offset     13.02 ms +- 0.02
