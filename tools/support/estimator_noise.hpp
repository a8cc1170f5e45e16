// SPDX-License-Identifier: MIT
// What an Allan analysis says to an estimator: N and K of both sensors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "support/allan_analysis.hpp"
#include "support/imu_noise.hpp"

/// The four densities for estimators, with comments on each and on everything that is wrong with the log. Values are
/// those of all axes together if they agree, else those of the worst axis: the one with the largest value among those
/// that have the term. An upper limit is used only if no axis has the term, because estimators reject zero. Nothing if
/// one of the sensors is missing, or N or K is not among the candidates.
struct EstimatorNoise {
  ImuNoise imu;
  std::vector<std::string> comments;
};
[[nodiscard]] std::optional<EstimatorNoise> estimator_noise(const LogNoise& noise);
