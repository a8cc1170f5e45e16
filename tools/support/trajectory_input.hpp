// SPDX-License-Identifier: MIT
// Trajectory files as arguments of a program: the options that describe a file, and reading it.
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
/// --times, --skip-bad-rows and --topic. If `file` is given, they need this option. A program with several files gives
/// each a `name`, with which its options begin: --reference-format.
void add_trajectory_options(CLI::App& app, TrajectoryInput& input, CLI::Option* file = nullptr,
                            const std::string& name = "");

/// Reads the file. Throws as splinertia::read_trajectory, std::invalid_argument for options that do not apply to the
/// file, and ScriptFailed if the script has rejected a bag and printed the reason on standard error.
[[nodiscard]] splinertia::TrajectoryFile read_trajectory_input(const TrajectoryInput& input);

/// The notes on how a file was read, as lines that begin with its name.
[[nodiscard]] std::string note_lines(const TrajectoryInput& input, const splinertia::TrajectoryFile& file);
