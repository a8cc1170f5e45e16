// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <splinertia/detail/inline.hpp>
#include <type_traits>

namespace splinertia::detail {

/// (x − sin x) / x³ for x² = `square` ≤ 2, where the difference cancels, from the Taylor series. 1/6 at 0.
template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T sine_defect(const T& square) {
  using Real = std::remove_cvref_t<decltype((std::numeric_limits<T>::max)())>;
  constexpr int digits = std::numeric_limits<T>::digits;
  constexpr int terms = digits <= 24 ? 6 : digits <= 53 ? 10 : digits <= 64 ? 11 : 2 + digits / 4;
  T series(1);
  for (int m = terms; m > 0; --m)
    series = T(1) - square * (T(1) / T(static_cast<Real>((2 * m + 2) * (2 * m + 3)))) * series;
  return series * (T(1) / T(6));
}

}  // namespace splinertia::detail
