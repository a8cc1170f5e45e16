// SPDX-License-Identifier: MIT
/// Economized power series (Lanczos), computed at compile time: the error on an interval is within a few percent of
/// that of the best polynomial of the same degree.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <array>
#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>

namespace splinertia::detail {

/// The number of terms of an economized series for which its error on [0, length] is at most `bound` times c_n(0).
/// T*_m(x/length), the shifted Chebyshev polynomial, has the leading coefficient 2^(2m−1)/length^m. Removing the term
/// of degree m of Σ (−x)^m/(2m + n)! therefore changes the sum by at most 2 (length/4)^m/(2m + n)!. All higher terms
/// together add less than a tenth of that.
[[nodiscard]] constexpr int economized_terms(int n, long double length, long double bound) {
  long double change = 2;
  int terms = 0;
  while (change * 1.1L > bound) {
    change *= length / 4 / static_cast<long double>((2 * terms + n + 1) * (2 * terms + n + 2));
    ++terms;
  }
  return terms;
}

/// The polynomial Σ a[m] x^m of Terms terms that on [0, length] is closest to a Taylor polynomial Σ b[m] y^m in
/// y = x/length, which is longer by so many terms that what it leaves out is negligible.
/// C. Lanczos, "Applied Analysis" (1956), VII.6: replace its highest term b y^m by b (y^m − T*_m(y)/2^(2m−1)), which has
/// degree m − 1, until Terms terms are left.
template <typename Real, int Terms, std::size_t Size>
[[nodiscard]] constexpr FixedArray<Real, Terms> economized(std::array<long double, Size> b, long double length) {
  // T*_m by its recursion T*_{m+1} = (4y − 2) T*_m − T*_{m−1}.
  std::array<std::array<long double, Size>, Size> chebyshev{};
  chebyshev[0][0] = 1;
  chebyshev[1][0] = -1;
  chebyshev[1][1] = 2;
  for (std::size_t m = 1; m + 1 < Size; ++m) {
    for (std::size_t i = 0; i < Size; ++i) {
      chebyshev[m + 1][i] = (i > 0 ? 4 * chebyshev[m][i - 1] : 0) - 2 * chebyshev[m][i] - chebyshev[m - 1][i];
    }
  }
  for (std::size_t m = Size; m-- > Terms;) {
    const long double factor = b[m] / chebyshev[m][m];
    for (std::size_t i = 0; i <= m; ++i) b[i] -= factor * chebyshev[m][i];
  }
  FixedArray<Real, Terms> a{};
  long double scale = 1;
  for (std::size_t m = 0; m < Terms; ++m) {
    a[m] = static_cast<Real>(b[m] * scale);
    scale /= length;
  }
  return a;
}

/// The polynomial with Terms terms that approximates Σ_m (−x)^m/(2m + n)! on [0, length].
template <typename Real, int Terms>
[[nodiscard]] constexpr FixedArray<Real, Terms> economized_series(int n, long double length) {
  FixedArray<long double, Terms + 8> b{};  // the first term left out is below 1e-10 of the accepted error
  long double term = 1;
  for (int i = 2; i <= n; ++i) term /= static_cast<long double>(i);
  int m = 0;
  for (long double& coefficient : b) {
    coefficient = term;
    term *= -length / static_cast<long double>((2 * m + n + 1) * (2 * m + n + 2));
    ++m;
  }
  return economized<Real, Terms>(b, length);
}

}  // namespace splinertia::detail
