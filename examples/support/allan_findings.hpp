// SPDX-License-Identifier: MIT
// What is wrong with a log, or with what was made of it, in words.
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
  double from, to;   ///< in `unit`; the same of what has no range
  std::string unit;  ///< Hz or s, since the beginning of the log or of averaging
  std::string text;  ///< one sentence, without the axis
  bool warning;      ///< what is reported does not hold, or holds without this only
};

/// That descriptions cannot be told apart, if there are several.
[[nodiscard]] std::optional<Finding> descriptions_finding(const splinertia::allan::NoiseEstimates<double>& noise,
                                                          splinertia::SensorKind kind);

/// Of one axis of this sensor.
[[nodiscard]] std::vector<Finding> findings_of(const splinertia::allan::Analysis<double>& analysis,
                                               const SensorLog& sensor);
