// SPDX-License-Identifier: MIT
// What a program throws to end with a certain exit code. Any other std::exception is bad input, exit code 2.
#pragma once

#include <stdexcept>

/// A result that is not good enough to be written. The message names the option that writes it anyway.
struct NotAccepted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A requested output could not be written.
struct OutputLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Bad input that has been reported on standard error.
struct AlreadyReported : std::runtime_error {
  using std::runtime_error::runtime_error;
};
