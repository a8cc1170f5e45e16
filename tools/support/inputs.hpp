// SPDX-License-Identifier: MIT
// The input files of a run, which it neither replaces nor removes.
#pragma once

#include <filesystem>
#include <splinertia/io/file_set.hpp>
#include <system_error>
#include <vector>

#include "support/trajectory_input.hpp"

using Inputs = std::vector<std::filesystem::path>;

/// The trajectory and the file of its stamps.
[[nodiscard]] inline Inputs inputs_of(const TrajectoryInput& input) { return {input.file, input.format.times}; }

/// Keeps the inputs. Empty paths are ignored. Of a folder, which a ROS 2 bag is, the bag files in it are kept.
inline void keep_inputs(splinertia::FileSet& files, const Inputs& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code ignored;  // the reader reports what is wrong
    for (const auto& entry : std::filesystem::directory_iterator(input, ignored)) {
      const auto ending = entry.path().extension();
      if (ending == ".db3" || ending == ".mcap" || entry.path().filename() == "metadata.yaml") files.keep(entry.path());
    }
    if (!input.empty()) files.keep(input);
  }
}
