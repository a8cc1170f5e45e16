// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "support/any_error_model.hpp"
#include "support/common_options.hpp"
#include "support/fit_choices.hpp"
#include "support/trajectory_input.hpp"

/// The command-line options.
struct Options {
  TrajectoryInput input;  // without a file: an analytic motion
  FitChoices fit;
  bool keep_holes = false;
  std::string motion = "ellipse";
  double duration = 20;
  std::optional<double> rate;  // default: that of the file imu_noise, else 200
  std::string preset = "euroc";
  std::filesystem::path errors, imu_noise;
  std::optional<double> gyro_noise, gyro_walk, accel_noise, accel_walk;
  GravityOption gravity;
  std::uint64_t seed = 0;
  std::filesystem::path output = ".";
  std::filesystem::path csv;
  bool npy = false;
  bool help_errors = false;
};

void add_options(CLI::App& app, Options& options);

/// Throws std::invalid_argument with the name of an option that is out of range.
void check(const Options& options);

/// The error model and the sampling rate (Hz) of the simulated IMU.
struct Sensor {
  AnyImu errors;
  double rate = 200;
};
[[nodiscard]] Sensor sensor_of(const Options& options);
