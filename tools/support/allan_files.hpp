// SPDX-License-Identifier: MIT
// The output files of an Allan analysis.
#pragma once

#include <vector>

#include "support/allan_analysis.hpp"
#include "support/imu_noise.hpp"
#include "support/output_folder.hpp"

/// Writes curves.csv, noise.csv, spectrum.csv, findings.csv and, if there is an estimator_noise, a file for each of the
/// estimators (imu.yaml, ...) and commits the folder. curves.csv exists only if all others do.
void write_files(const LogNoise& noise, OutputFolder& folder,
                 const std::vector<Estimator>& for_estimators = {estimators.begin(), estimators.end()});
