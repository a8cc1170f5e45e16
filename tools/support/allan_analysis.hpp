// SPDX-License-Identifier: MIT
// The Allan analysis of a static log.
#pragma once

#include <optional>
#include <splinertia/allan/analysis.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/allan_findings.hpp"
#include "support/imu_log.hpp"

struct AxisNoise {
  char name;  ///< x, y, z
  splinertia::allan::Analysis<double> analysis;
  std::vector<Finding> findings;

  [[nodiscard]] const splinertia::allan::NoiseEstimates<double>& noise() const { return analysis.noise; }
};

struct SensorNoise {
  splinertia::SensorKind kind;
  double rate;      ///< Hz
  double duration;  ///< s
  std::vector<AxisNoise> axes;
  /// The estimates of all axes together. Only if there are several, they agree, and each is described by its terms.
  std::optional<splinertia::allan::NoiseEstimates<double>> pooled;
  std::optional<Finding> pooled_finding;  ///< descriptions that all axes together cannot tell apart

  /// The estimates of one axis, or of all axes together if its name is "all".
  struct Row {
    std::string name;
    const splinertia::allan::NoiseEstimates<double>* noise;
    splinertia::allan::Adequacy adequacy;
    bool disturbed = false;  ///< has steps or freezes, which can look like slow terms
  };
  [[nodiscard]] std::vector<Row> rows() const;
};

struct LogNoise {
  std::string log;  ///< its path
  double rate;      ///< Hz, of the first sensor
  double duration;  ///< s, of the first sensor
  splinertia::allan::IdentifyOptions<double> options;
  std::vector<SensorNoise> sensors;
  std::optional<std::string> topic{};  ///< of the ROS bag, if it is one
};

/// The overlapping Allan deviation of each axis with 68.3 % intervals, and the noise terms of each axis and of all axes
/// together if they agree. Analyses up to `threads` axes at once; 0: as many as the hardware runs at once. Throws
/// std::runtime_error with log, sensor and axis if a signal cannot be analysed.
[[nodiscard]] LogNoise analyse(const ImuLog& log, const splinertia::allan::IdentifyOptions<double>& options,
                               unsigned threads = 1);

/// adequate, partial, inadequate
[[nodiscard]] std::string_view name(splinertia::allan::Adequacy adequacy);
