// SPDX-License-Identifier: MIT
// The calibration of an IMU as a YAML file: fit_trajectory writes it, dead_reckon reads it.
#pragma once

#include <filesystem>
#include <splinertia/calibration/inertial_fit.hpp>
#include <string>

/// The text of the file: every number of ImuCalibration with its standard deviation, and units as comments. Throws
/// std::invalid_argument for a number that is not finite; a standard deviation may be infinite (.inf in YAML).
[[nodiscard]] std::string calibration_text(const splinertia::CalibratedImu<double>& imu);

/// Writes the file, complete or not at all. Throws as calibration_text() and AtomicFile do.
void write_calibration(const std::filesystem::path& path, const splinertia::CalibratedImu<double>& imu);

/// Reads such a file to the same bits. The file has no residuals and no iterations: these are 0, and `converged` is
/// true. Throws std::runtime_error with file:line for an entry that is unknown, missing, duplicated, not finite or of
/// the wrong length.
[[nodiscard]] splinertia::CalibratedImu<double> read_calibration(const std::filesystem::path& path);
