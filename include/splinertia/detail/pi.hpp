// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>

namespace splinertia::detail {

/// π with the precision of the scalar. std::numbers::pi_v<long double> of libc++ has that of double.
template <typename Scalar>
[[nodiscard]] constexpr Scalar pi_of() {
  if constexpr (std::floating_point<Scalar>) {
    return static_cast<Scalar>(3.141592653589793238462643383279502884L);
  } else {
    using std::acos;
    return Scalar(2) * acos(Scalar(0));
  }
}

}  // namespace splinertia::detail
