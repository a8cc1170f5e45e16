// SPDX-License-Identifier: MIT
// The output files of an Allan analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "support/allan_analysis.hpp"
#include "support/imu_noise.hpp"
#include "support/output_folder.hpp"

/// The four densities for estimators, with comments on each and on everything that is wrong with the log. Values are
/// those of all axes together if they agree, else those of the worst axis: the one with the largest value among those
/// that have the term. An upper limit is used only if no axis has the term, because estimators reject zero. Nothing if
/// one of the sensors is missing, or N or K is not among the candidates.
struct EstimatorNoise {
  ImuNoise imu;
  std::vector<std::string> comments;
};
[[nodiscard]] std::optional<EstimatorNoise> estimator_noise(const LogNoise& noise);

/// Writes curves.csv, noise.csv, spectrum.csv, findings.csv and, if there is an estimator_noise, a file for each of the
/// estimators (imu.yaml, ...) and commits the folder. curves.csv exists only if all others do.
void write_files(const LogNoise& noise, OutputFolder& folder,
                 const std::vector<Estimator>& for_estimators = {estimators.begin(), estimators.end()});
