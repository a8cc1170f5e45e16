// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "support/trajectory_input.hpp"

/// What the command line says.
struct Options {
  std::filesystem::path trajectory;
  TrajectoryInput input;  // how to read it
  int order = 4;
  std::string group = "split";

  // How knots are placed: by at most one of these, and by default at an interval.
  std::optional<double> knot_interval;                 // s
  std::optional<double> goal_position, goal_rotation;  // m, rad
  bool cross_validate = false, adaptive = false, interpolate = false;

  std::string loss = "huber";
  std::optional<double> position_deviation, rotation_deviation;  // m, rad
  std::optional<double> position_density, rotation_density;      // of the derivative
  int smooth_derivative = 2;
  double outlier_limit = 6;
  int most_iterations = 100;

  std::filesystem::path imu;  // empty: none
  bool estimate_lever_arm = false, estimate_time_offset = false, fit_imu = false;
  std::optional<double> gyro_deviation, accel_deviation;  // rad/s, m/s²
  std::vector<double> gravity{0, 0, -9.80665};

  double rate = 200;
  std::filesystem::path output = ".";
  std::string python;
  bool no_plot = false;

  Eigen::Vector3d gravity_vector() const {
    return gravity.size() == 1 ? Eigen::Vector3d(0, 0, -gravity[0]) : Eigen::Vector3d(gravity.data());
  }
};
