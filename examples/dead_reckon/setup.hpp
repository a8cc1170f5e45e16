// SPDX-License-Identifier: MIT
// What is known of the IMU and of gravity, and from where.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <splinertia/imu/ideal_imu.hpp>
#include <string>

#include "dead_reckon/options.hpp"

struct Setup {
  std::optional<Eigen::Vector3d> gyro_bias, accel_bias;  // none: those of the trajectory file
  std::string gyro_bias_source, accel_bias_source;       // empty: not removed
  splinertia::LeverArm<double> arm{Sophus::SO3d(), Eigen::Vector3d::Zero()};
  std::string arm_source;  // empty: the poses are those of the IMU
  Eigen::Vector3d gravity;
  std::string gravity_source;
  double time_offset = 0;  // s: time of the trajectory's clock - time of the IMU's
};

/// Each quantity is taken from its option; without that from the calibration file; without that, biases from the
/// trajectory file. Throws as read_calibration() does.
[[nodiscard]] Setup setup(const Options& options, bool trajectory_has_biases);

/// What was used, in words: the biases, and a line for each of the others that is not the default.
[[nodiscard]] std::string bias_text(const Setup& setup);
[[nodiscard]] std::string mounting_text(const Setup& setup);
