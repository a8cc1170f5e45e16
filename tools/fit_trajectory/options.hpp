// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "support/common_options.hpp"
#include "support/fit_choices.hpp"
#include "support/fitted_trajectory.hpp"
#include "support/trajectory_input.hpp"

/// The command-line options.
struct Options {
  TrajectoryInput input;
  FitChoices fit;
  FitImu imu;  // not used if it has no file
  GravityOption gravity;
  double rate = 200;
  bool keep_holes = false;
  std::filesystem::path output = ".";
  std::string python;
  bool no_plot = false;
};
