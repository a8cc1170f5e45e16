// SPDX-License-Identifier: MIT
// What every program does around its work: options, exit codes, errors in one line.
#pragma once

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

/// A result that is not good enough to be written. What is said then names the option that takes it all the same.
struct NotAccepted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Something that was asked for could not be written.
struct OutputLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Parses the options and does the work. Exit codes: 0 done, 1 output is lost, 2 bad input or usage, 3 not
/// accepted.
[[nodiscard]] int run_program(const char* name, CLI::App& app, int argc, char** argv, const auto& work) {
  const auto fail = [name](int code, const char* why) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s: %s\n", name, why);
    return code;
  };
  try {
    app.parse(argc, argv);
    work();
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) != 0) return 2;
  } catch (const OutputLost& error) {
    return fail(1, error.what());
  } catch (const NotAccepted& error) {
    return fail(3, error.what());
  } catch (const std::exception& error) {
    return fail(2, error.what());
  }
  errno = 0;
  const bool lost = std::fflush(stdout) != 0;
  if (!lost && std::ferror(stdout) == 0) return 0;
  return fail(1, errno != 0 ? std::strerror(errno) : "standard output cannot be written");
}
