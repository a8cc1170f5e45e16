// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "options.hpp"
#include "support/fitted_trajectory.hpp"
#include "support/output_folder.hpp"

struct WrittenFiles {
  std::string names;  // "control_points.csv, ... and smoothed.tum"
  std::string note;   // on the readings in holes; empty if there are none
};

/// Writes all files except the plot, or none. control_points.csv exists only if all others do.
[[nodiscard]] WrittenFiles write_files(const FittedTrajectory& fitted, const std::string& report,
                                       const Options& options, OutputFolder& folder);
