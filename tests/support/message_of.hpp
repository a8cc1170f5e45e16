// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace splinertia::testing {

/// What std::invalid_argument says that `work` throws.
[[nodiscard]] std::string message_of(const auto& work) {
  try {
    (void)work();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

}  // namespace splinertia::testing
