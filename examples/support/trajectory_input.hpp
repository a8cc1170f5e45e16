// SPDX-License-Identifier: MIT
// Trajectory files of every kind as an argument of a program: the options that describe one, and reading it.
#pragma once

#include <filesystem>
#include <optional>
#include <splinertia/io/trajectory.hpp>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// A trajectory to read, and how.
struct TrajectoryInput {
  std::filesystem::path file;  ///< text in any format of read_trajectory, or a ROS bag (.bag, .mcap, .db3, a folder)
  splinertia::TrajectoryFormat format{};
  std::optional<std::string> topic{};  ///< of a bag; needed if there are several with poses
};

/// Adds the options that describe a trajectory file: --format, --columns, --quaternion-order, --time-unit, --pose-rate,
/// --times, --skip-bad-rows and --topic. They need the option `file`, if there is one. A program with several files
/// gives each a `name`, which begins its options: --reference-format.
void add_trajectory_options(CLI::App& app, TrajectoryInput& input, CLI::Option* file = nullptr,
                            const std::string& name = "");

/// Reads it. Throws as splinertia::read_trajectory, std::invalid_argument for options that do not go with the file, and
/// ScriptFailed where a bag has been refused and the reason said on standard error.
[[nodiscard]] splinertia::TrajectoryFile read_trajectory_input(const TrajectoryInput& input);

/// The notes of a file as lines that begin with its name, for the report of a program.
[[nodiscard]] std::string note_lines(const TrajectoryInput& input, const splinertia::TrajectoryFile& file);
