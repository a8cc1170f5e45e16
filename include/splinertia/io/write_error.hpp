// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <stdexcept>

namespace splinertia {

/// The system failed to write: disk full, file too large, … The message has path and reason.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace splinertia
