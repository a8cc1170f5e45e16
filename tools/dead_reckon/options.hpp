// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "support/common_options.hpp"
#include "support/trajectory_input.hpp"

/// The command-line options.
struct Options {
  std::filesystem::path imu, csv;
  TrajectoryInput trajectory;
  std::string scheme = "midpoint";
  std::vector<double> windows{1, 5, 10};  // s
  double longest_gap = 0.1;               // s
  bool bridge = false;

  std::filesystem::path calibration;                                // empty: none
  std::optional<Eigen::Vector3d> gyro_bias, accel_bias, lever_arm;  // rad/s, m/s², m
  bool keep_biases = false;
  GravityOption gravity;
  bool gravity_given = false;
};
