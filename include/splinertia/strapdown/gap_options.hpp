// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace splinertia {

/// What to do with a gap, an interval between samples that is too long.
enum class GapPolicy {
  refuse,  ///< throw std::invalid_argument
  bridge,  ///< integrate across it as if the signal were smooth, and count it
};

template <typename Scalar = double>
struct GapOptions {
  /// The longest interval that is not a gap, s. With infinity (with -ffast-math: the largest number) nothing is a gap.
  /// Default: ten times the mean of the intervals before, gaps excluded, but at least 0.1 s. Then an IMU may drop 19
  /// samples in a row at 200 Hz and nine at 1 Hz. The first interval has none before it and is judged together with the
  /// second.
  std::optional<Scalar> longest{};
  GapPolicy policy = GapPolicy::refuse;
};

}  // namespace splinertia
