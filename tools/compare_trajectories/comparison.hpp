// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <splinertia/evaluation/trajectory_error.hpp>
#include <splinertia/evaluation/trajectory_time_offset.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <string>
#include <vector>

#include "compare_trajectories/options.hpp"

using Poses = std::vector<splinertia::Stamped<splinertia::SO3xR3<double>>>;
using Pairs = std::vector<splinertia::PosePair<splinertia::SO3xR3<double>>>;

/// One line of the table.
struct Row {
  std::string metric, part, unit;
  splinertia::ErrorStatistics<double> errors;
};

struct Comparison {
  std::optional<splinertia::TimeOffset> estimated_offset;
  double time_offset;  // s, added to the estimate's stamps
  splinertia::SimilarityTransform<double> transform;
  Pairs pairs;  // aligned
  std::vector<splinertia::PoseError<double>> absolute;
  std::vector<Row> rows;              // ATE, RPE, drift
  std::string no_relative, no_drift;  // why there is no RPE, or no drift over some lengths
};

/// Throws std::exception if the trajectories do not allow what the options ask for.
[[nodiscard]] Comparison compare(const Poses& reference, Poses estimate, const Options& options);
