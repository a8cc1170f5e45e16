// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace splinertia {

/// What to do with a gap: an interval between samples that is longer than it should be.
enum class GapPolicy {
  refuse,  ///< throw std::invalid_argument
  bridge,  ///< integrate across it as if the signal were smooth, and count it
};

template <typename Scalar = double>
struct GapOptions {
  /// The longest interval that is no gap, s; infinity for any (with -ffast-math the largest number). Unset, it is ten
  /// times the mean of the intervals before, gaps left out, but at least 0.1 s: an IMU of 200 Hz may drop 19 samples in
  /// a row, one of 1 Hz nine. The interval after the first sample has none before it, and is judged together with the
  /// next one.
  std::optional<Scalar> longest{};
  GapPolicy policy = GapPolicy::refuse;
};

}  // namespace splinertia
