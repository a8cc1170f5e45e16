// SPDX-License-Identifier: MIT
// The options that several programs have.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

// Each function adds one option and returns it, for group(), check(), needs() and count(). --help shows the value that
// the variable has at the call as the default.

/// -o,--output: the folder for the output files.
CLI::Option* add_output_option(CLI::App& app, std::filesystem::path& folder, const std::string& description);

/// --csv: a file for the table that the program prints.
CLI::Option* add_csv_option(CLI::App& app, std::filesystem::path& file, const std::string& description);

/// --no-plot: without it the program draws PICTURE.png and PICTURE.svg.
CLI::Option* add_no_plot_option(CLI::App& app, bool& no_plot, const std::string& picture);

/// --python: the interpreter, by default that of default_python(). `use` ends "Python interpreter ...".
CLI::Option* add_python_option(CLI::App& app, std::string& python, const std::string& use = "for the plot");

/// --rate: a sampling rate in Hz.
CLI::Option* add_rate_option(CLI::App& app, double& rate, const std::string& description = "sampling rate [Hz]");
CLI::Option* add_rate_option(CLI::App& app, std::optional<double>& rate, const std::string& description);

/// --seed: takes whole numbers from 0 to 2^64 - 1 and rejects everything else. CLI11 alone reads -1, and numbers that
/// are too large, as the largest of them.
CLI::Option* add_seed_option(CLI::App& app, std::uint64_t& seed, const std::string& description);

/// The acceleration of free fall in the world, m/s².
struct GravityOption {
  Eigen::Vector3d vector{0, 0, -9.80665};
};

/// --gravity: three numbers, or a magnitude along -z. The parser rejects a negative magnitude, whose sign would be
/// ambiguous, and numbers that are not finite.
CLI::Option* add_gravity_option(CLI::App& app, GravityOption& gravity);
