// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "fitted_trajectory.hpp"
#include "options.hpp"

/// What is said of the fit, with warnings at the end.
[[nodiscard]] std::string report(const Poses& poses, std::size_t samples, const FittedTrajectory& fitted,
                                 const Options& options);

/// Writes the files but the plot, all or none of them, and returns what they are called.
[[nodiscard]] std::vector<std::string> write_files(const FittedTrajectory& fitted, const std::string& report,
                                                   const Options& options);
