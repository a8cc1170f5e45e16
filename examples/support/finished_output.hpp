// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>

/// The exit code of a program that has printed all it had to: 0, or 1 if standard output did not take it (a full disk).
[[nodiscard]] inline int finished_output(const char* program) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
  std::fprintf(stderr, "%s: standard output cannot be written\n", program);
  return 1;
}
