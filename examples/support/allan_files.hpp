// SPDX-License-Identifier: MIT
// The files that an Allan analysis leaves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "support/allan_analysis.hpp"
#include "support/imu_noise.hpp"
#include "support/output_folder.hpp"

/// The four densities that estimators want, and a line about each and about all that is wrong with the log: those of
/// all axes together if they agree, else of the worst axis. The worst has the largest value among those that have the
/// term: an upper limit is taken only if none has, because estimators refuse zero. Nothing if there are not both
/// sensors, or not N and K among the candidates.
struct EstimatorNoise {
  ImuNoise imu;
  std::vector<std::string> comments;
};
[[nodiscard]] std::optional<EstimatorNoise> estimator_noise(const LogNoise& noise);

/// Writes curves.csv, noise.csv, spectrum.csv, findings.csv and, if there is an estimator_noise, a file for each of the
/// estimators (imu.yaml, ...) and commits the folder. curves.csv is there only if all others are.
void write_files(const LogNoise& noise, OutputFolder& folder,
                 const std::vector<Estimator>& for_estimators = {estimators.begin(), estimators.end()});
