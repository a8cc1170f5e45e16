// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace CLI {
class App;
}

/// The command-line options.
struct Options {
  double duration = 10;
  double knot_interval = 0.1;
  double imu_rate = 200;
  double pose_rate = 10;
  double position_noise = 0.02, attitude_noise = 0.01;  // standard deviations, m and rad
  double gyro_noise = 1e-3, accel_noise = 1e-2;         // densities
  double gravity_tilt = 5;                              // deg
  std::uint64_t seed = 0;
  int iterations = 50;
  std::filesystem::path csv;
};

void add_options(CLI::App& app, Options& options);

/// Throws std::invalid_argument for an option that is out of range. Most are divisors and must be positive.
void check(const Options& options);
