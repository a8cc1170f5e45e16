// SPDX-License-Identifier: MIT
/// Poses and the samples of an IMU along a known motion, with white noise: what a fit has to find again.
#pragma once

#include <cmath>
#include <splinertia/calibration/imu_calibration.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <vector>

namespace splinertia::testing {

/// An IMU that is mounted, biased and late as they are, in a world that is not quite level.
inline ImuCalibration<double> some_imu() {
  return {.gyro_bias = {0.01, -0.02, 0.03},
          .accel_bias = {0.1, -0.2, 0.15},
          .gravity = {0.4, -0.3, -9.79},
          .mounting = {Sophus::SO3d::exp({0.3, -1.2, 2.1}), {0.2, -0.1, 0.15}},
          .time_offset = 0.013};
}

/// The poses of a motion at a rate, both ends included, with white noise of these standard deviations (rad, m).
template <Pose G>
std::vector<Stamped<G, double>> poses_along(const auto& motion, double start, double end, double rate,
                                            double rotation_noise, double position_noise, StreamKey key) {
  NormalStream normal(key / "poses");
  std::vector<Stamped<G, double>> poses;
  const auto count = static_cast<int>(std::lround((end - start) * rate));
  for (int i = 0; i <= count; ++i) {
    const double time = start + (end - start) * i / count;
    const auto value = motion.template evaluate<0>(time).value;
    Eigen::Vector3d turn, shift;
    for (double& x : turn) x = rotation_noise * normal();
    for (double& x : shift) x = position_noise * normal();
    poses.push_back({time, make_pose<G>(rotation(value) * Sophus::SO3d::exp(turn), position(value) + shift)});
  }
  return poses;
}

/// What the IMU reads from `start` to `end` of its own clock, with white noise of these standard deviations.
inline std::vector<ImuSample<>> samples_along(const auto& motion, const ImuCalibration<double>& imu, double start,
                                              double end, double rate, double gyro_noise, double accel_noise,
                                              StreamKey key) {
  NormalStream normal(key / "samples");
  std::vector<ImuSample<>> samples;
  const auto count = static_cast<int>(std::lround((end - start) * rate));
  for (int i = 0; i <= count; ++i) {
    const double time = start + (end - start) * i / count;
    auto [gyro, accel] = predicted_imu(motion.template evaluate<2>(time + imu.time_offset), imu);
    for (double& x : gyro) x += gyro_noise * normal();
    for (double& x : accel) x += accel_noise * normal();
    samples.push_back({time, gyro, accel});
  }
  return samples;
}

}  // namespace splinertia::testing
