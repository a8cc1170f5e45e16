// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

#include "support/concat.hpp"

/// Throws std::invalid_argument that names --rate for a rate (Hz) that is not positive or too high for stamps in whole
/// nanoseconds, and for a billion samples or more in `duration` seconds.
inline void check_sampling_rate(double rate, double duration) {
  if (!(rate > 0 && rate <= 1e9)) {
    throw std::invalid_argument(
        concat("--rate: ", rate, " Hz, expected a positive number up to 1e9, since stamps are whole nanoseconds"));
  }
  if (!(rate * duration < 1e9)) {
    throw std::invalid_argument(concat("--rate: ", rate, " Hz for ", duration, " s makes ", rate * duration,
                                       " samples, expected less than 1e9"));
  }
}
