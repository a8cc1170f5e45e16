// SPDX-License-Identifier: MIT
// The report of a fit: results and warnings. All programs that fit a curve print the same.
#pragma once

#include <string>

#include "support/extremes.hpp"
#include "support/fitted_trajectory.hpp"

/// `imu` may be null.
[[nodiscard]] std::string fit_report(const FitInput& input, const FittedTrajectory& fitted, const FitChoices& choices,
                                     const FitImu* imu, const Extremes& found);

/// The part on the calibration of an IMU.
[[nodiscard]] std::string imu_report(const FittedImu& fitted, const FitImu& imu);
