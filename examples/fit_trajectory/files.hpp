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

/// Writes the files but the plot, all or none of them. control_points.csv is there only if all others are.
[[nodiscard]] WrittenFiles write_files(const FittedTrajectory& fitted, const std::string& report,
                                       const Options& options, OutputFolder& folder);
