// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "options.hpp"
#include "support/fitted_trajectory.hpp"

struct WrittenFiles {
  std::vector<std::string> names;  // of the files
  std::string note;                // on the readings in holes; empty if there are none
};

/// Writes the files but the plot, all or none of them.
[[nodiscard]] WrittenFiles write_files(const FittedTrajectory& fitted, const std::string& report,
                                       const Options& options);
