// SPDX-License-Identifier: MIT
// Findings: problems of a log or of its analysis, in words.
#pragma once

#include <optional>
#include <splinertia/allan/analysis.hpp>
#include <string>
#include <vector>

#include "support/imu_log.hpp"

/// One thing that a reader of the results must know. Kinds: excluded and unused (bands of frequencies), misfit
/// (averaging times), fit, step, withheld, freeze, saturation, disturbance, resolution, white_noise, descriptions.
struct Finding {
  std::string kind;
  double from, to;   ///< in `unit`; equal if there is no range
  std::string unit;  ///< Hz or s, since the beginning of the log or of averaging
  std::string text;  ///< one sentence, without the axis
  bool warning;      ///< the results do not hold, or hold only without this part
};

/// The finding that several descriptions cannot be told apart; nothing if there is only one.
[[nodiscard]] std::optional<Finding> descriptions_finding(const splinertia::allan::NoiseEstimates<double>& noise,
                                                          splinertia::SensorKind kind);

/// The findings of one axis of this sensor.
[[nodiscard]] std::vector<Finding> findings_of(const splinertia::allan::Analysis<double>& analysis,
                                               const SensorLog& sensor);
