// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <splinertia/evaluation/trajectory_alignment.hpp>
#include <string>
#include <vector>

#include "support/trajectory_input.hpp"

/// The command-line options.
struct Options {
  TrajectoryInput reference, estimate;

  double max_difference = 0.01;  // s
  double time_offset = 0;        // s, added to the estimate's stamps
  bool estimate_time_offset = false;
  double time_offset_range = 1;  // s

  std::string align = "none";
  std::optional<std::size_t> align_poses;  // default: all

  double delta = 1;
  std::string unit = "frames";
  bool all_pairs = false;
  std::vector<double> lengths{100, 200, 300, 400, 500, 600, 700, 800};  // m

  std::filesystem::path csv, errors, plot;  // empty: not written
  std::string python;
};

inline const std::map<std::string, splinertia::Alignment> alignments{{"none", splinertia::Alignment::none},
                                                                     {"origin", splinertia::Alignment::origin},
                                                                     {"yaw", splinertia::Alignment::yaw},
                                                                     {"se3", splinertia::Alignment::se3},
                                                                     {"sim3", splinertia::Alignment::sim3}};
