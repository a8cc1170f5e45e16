// SPDX-License-Identifier: MIT
// In words and numbers: what a fit has found, and what to be careful about. All programs that fit say the same.
#pragma once

#include <string>

#include "support/extremes.hpp"
#include "support/fitted_trajectory.hpp"

/// `imu` may be none.
[[nodiscard]] std::string fit_report(const FitInput& input, const FittedTrajectory& fitted, const FitChoices& choices,
                                     const FitImu* imu, const Extremes& found);

/// The part on the calibration of an IMU.
[[nodiscard]] std::string imu_report(const FittedImu& fitted, const FitImu& imu);
