// SPDX-License-Identifier: MIT
// The calibration of the IMU and gravity, and where each value comes from.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <splinertia/imu/ideal_imu.hpp>
#include <string>

#include "dead_reckon/options.hpp"

struct Setup {
  std::optional<Eigen::Vector3d> gyro_bias, accel_bias;  // none: from the trajectory file
  std::string gyro_bias_source, accel_bias_source;       // empty: not removed
  splinertia::Mounting<double> mounting{};
  std::string arm_source;  // empty: the poses are those of the IMU
  Eigen::Vector3d gravity;
  std::string gravity_source;
  double time_offset = 0;  // s: time of the trajectory's clock - time of the IMU's
};

/// Each quantity is taken from its option; without that from the calibration file; without that, biases from the
/// trajectory file. Throws as read_calibration() does.
[[nodiscard]] Setup setup(const Options& options, bool trajectory_has_biases);

/// Text on the values in use: bias_text() on the biases, mounting_text() with a line for each other value that is not
/// the default.
[[nodiscard]] std::string bias_text(const Setup& setup);
[[nodiscard]] std::string mounting_text(const Setup& setup);
