// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <concepts>

namespace splinertia::allan::detail {

/// Returns x and keeps the compiler from simplifying across it: with -ffast-math, (a + b) − a would become b. g++ has a
/// builtin for this since version 12. For clang, CompensatedSum::add() has a pragma.
template <typename Scalar>
[[nodiscard]] constexpr Scalar as_written(Scalar x) {
#if __has_builtin(__builtin_assoc_barrier)
  if constexpr (std::floating_point<Scalar>) return __builtin_assoc_barrier(x);
#elif (defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__)) && !defined(__clang__)
#warning "-ffast-math disables compensated summation with this compiler: Allan deviations lose digits"
#endif
  return x;
}

/// A sum whose rounding error does not grow with the number of summands. The error of each addition is computed exactly
/// (Knuth's TwoSum) and summed separately (Neumaier, ZAMM 54 (1974)). |error| ≤ eps·|sum| + (n·eps)²·Σ|x|. In double
/// the second part is below eps·Σ|x| for n up to 6·10⁷.
template <typename Scalar>
class CompensatedSum {
 public:
  constexpr void add(Scalar x) {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
    const Scalar sum = as_written(sum_ + x);
    const Scalar x_seen = as_written(sum - sum_);
    lost_ += as_written(sum_ - as_written(sum - x_seen)) + as_written(x - x_seen);
    sum_ = sum;
  }

  [[nodiscard]] constexpr Scalar value() const { return sum_ + lost_; }

 private:
  Scalar sum_{0};
  Scalar lost_{0};
};

}  // namespace splinertia::allan::detail
