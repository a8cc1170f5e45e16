// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "support/exit_code.hpp"

namespace CLI {
class App;
}

/// A program with options. Each source of a program defines `this_program`; main() is in main.cpp. Exit codes: 0 done, 1
/// output is lost, 2 bad input or usage, 3 not accepted.
struct Program {
  const char* name;         ///< before each message
  const char* description;  ///< for --help
  /// Adds the options and returns the work, which is done when they have been parsed.
  std::function<void()> (*set_up)(CLI::App& app);
};
extern const Program this_program;
