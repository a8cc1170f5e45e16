// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <stdexcept>

namespace splinertia {

/// The system has refused to write on: disk full, file too large, … The text has path and reason.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace splinertia
