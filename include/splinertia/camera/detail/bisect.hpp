// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/select.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia::detail {

/// A number between 0 ≤ low < high for bisection: between their exponents while these are far from each other, so that
/// any interval shrinks to neighbouring numbers in less than a hundred steps.
template <typename Scalar>
[[nodiscard]] Scalar middle_of(const Scalar& low, const Scalar& high) {
  if (high > Scalar(1) && low < Scalar(1)) return Scalar(1);
  if (low > Scalar(0) && high / Scalar(4) > low) return square_root<Scalar>(low) * square_root<Scalar>(high);
  return low + (high - low) / Scalar(2);
}

/// The root of a continuous f that has another sign at `low` ≥ 0 than at `high`, by bisection to neighbouring numbers.
template <typename Scalar>
[[nodiscard]] Scalar bisect(const auto& f, Scalar low, Scalar high) {
  const bool positive = f(low) > Scalar(0);
  for (;;) {
    const Scalar middle = middle_of(low, high);
    if (!(low < middle && middle < high)) return middle;
    (((f(middle) > Scalar(0)) == positive) ? low : high) = middle;
  }
}

}  // namespace splinertia::detail
