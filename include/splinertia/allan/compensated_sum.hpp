// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/cpp20.hpp>

namespace splinertia::allan {

/// A sum whose rounding error does not grow with the number of summands: each addition's error is found exactly
/// (Knuth's TwoSum) and added up on the side (Neumaier, ZAMM 54 (1974)). |error| ≤ eps·|sum| + (n·eps)²·Σ|x|, of which
/// the second part is beyond double for any n that fits in memory. Not for -ffast-math, which removes it.
template <typename Scalar>
class CompensatedSum {
 public:
  constexpr void add(Scalar x) {
    const Scalar sum = sum_ + x;
    const Scalar x_seen = sum - sum_;
    lost_ += (sum_ - (sum - x_seen)) + (x - x_seen);
    sum_ = sum;
  }

  [[nodiscard]] constexpr Scalar value() const { return sum_ + lost_; }

 private:
  Scalar sum_{0};
  Scalar lost_{0};
};

}  // namespace splinertia::allan
