// SPDX-License-Identifier: MIT
// The subcommand `allan deviation`: one deviation of a column of numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

struct DeviationOptions {
  std::filesystem::path file;
  std::string type = "oadev", factors = "octave", intervals = "published";
  double rate = 1;
  bool rate_data = false, phase_data = false;
  double confidence = 0.683;  // as in Stable32; one sigma is 0.6827
  std::optional<int> alpha;
};

void add_deviation_options(CLI::App& app, DeviationOptions& options);

/// Prints the curve as a table of comma-separated values. Throws std::invalid_argument for options, std::runtime_error
/// with the path of the file for numbers that cannot be used.
void print_deviation(const DeviationOptions& options);
