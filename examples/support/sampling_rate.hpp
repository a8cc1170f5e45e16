// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/message.hpp>
#include <stdexcept>

/// Throws std::invalid_argument, naming the option --rate, for a rate in Hz that the clock of files, in nanoseconds,
/// cannot tell apart, and for a billion samples or more over so many seconds.
inline void check_sampling_rate(double rate, double duration) {
  if (!(rate > 0 && rate <= 1e9)) {
    throw std::invalid_argument(splinertia::message(
        "--rate: ", rate, " Hz, expected a positive number up to 1e9, since stamps are whole nanoseconds"));
  }
  if (!(rate * duration < 1e9)) {
    throw std::invalid_argument(splinertia::message("--rate: ", rate, " Hz for ", duration, " s makes ",
                                                    rate * duration, " samples, expected less than 1e9"));
  }
}
