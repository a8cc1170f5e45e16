// SPDX-License-Identifier: MIT
// What is wrong with a log, or with what was made of it, in words.
#pragma once

#include <functional>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/imu/describe.hpp>
#include <string>
#include <vector>

/// One thing that a reader of the results must know. Kinds: excluded and unused (bands of frequencies), misfit
/// (averaging times), fit, step, freeze, resolution, white_noise, descriptions.
struct Finding {
  std::string kind;
  double from, to;   ///< in `unit`; the same of what has no range
  std::string unit;  ///< Hz or s, since the beginning of the log or of averaging
  std::string text;  ///< one sentence, without the axis
  bool warning;      ///< what is reported does not hold, or holds without this only
};

/// Of one axis; `log_time` gives the time since the beginning of the log [s] of a time since the first sample that was
/// analysed.
[[nodiscard]] std::vector<Finding> findings_of(const splinertia::allan::Analysis<double>& analysis,
                                               splinertia::SensorKind kind,
                                               const std::function<double(double)>& log_time);
