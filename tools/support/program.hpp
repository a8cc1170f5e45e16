// SPDX-License-Identifier: MIT
// The frame of every program with options.
#pragma once

#include <CLI/CLI.hpp>

#include "support/exit_code.hpp"

/// Parses the options and calls work(). Exit codes: 0 done, 1 output is lost, 2 bad input or usage, 3 not accepted.
[[nodiscard]] int run_program(const char* name, CLI::App& app, int argc, char** argv, const auto& work) {
  return run_program(name, [&] {
    try {
      app.parse(argc, argv);
      work();
    } catch (const CLI::ParseError& error) {
      if (app.exit(error) != 0) throw AlreadyReported(error.what());
    }
  });
}
