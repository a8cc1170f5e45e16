// SPDX-License-Identifier: MIT
/// Power series of which a few terms have been distributed over the others (Lanczos' economization), worked out by the
/// compiler: within a few percent of the best polynomial of its degree on a whole interval.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>

namespace splinertia {

/// Terms of an economized series: how many are enough for `bound` times c_n(0) on [0, length].
/// The shifted Chebyshev polynomial T*_m of x/length has the leading coefficient 2^(2m−1)/length^m, so that taking out
/// the term of degree m of Σ (−x)^m/(2m + n)! changes the sum by at most 2 (length/4)^m/(2m + n)!; the terms above add
/// less than a tenth of that.
[[nodiscard]] constexpr int economized_terms(int n, long double length, long double bound) {
  long double change = 2;
  int terms = 0;
  while (change * 1.1L > bound) {
    change *= length / 4 / static_cast<long double>((2 * terms + n + 1) * (2 * terms + n + 2));
    ++terms;
  }
  return terms;
}

/// Coefficients of a polynomial Σ_m a[m] x^m of Terms terms for Σ_m (−x)^m/(2m + n)! on [0, length].
/// C. Lanczos, "Applied Analysis" (1956), VII.6: starting from a long enough Taylor polynomial in y = x/length, the
/// highest term b y^m is replaced by b (y^m − T*_m(y)/2^(2m−1)), of degree m − 1, until Terms are left.
template <typename Real, int Terms>
[[nodiscard]] constexpr FixedArray<Real, Terms> economized_series(int n, long double length) {
  constexpr int size = Terms + 8;  // the first one left out is below 1e-10 of the error that is accepted
  FixedArray<long double, size> b{};
  long double term = 1;
  for (int i = 2; i <= n; ++i) term /= static_cast<long double>(i);
  for (int m = 0; m < size; ++m) {
    b[static_cast<std::size_t>(m)] = term;
    term *= -length / static_cast<long double>((2 * m + n + 1) * (2 * m + n + 2));
  }
  // T*_m by its recursion T*_{m+1} = (4y − 2) T*_m − T*_{m−1}.
  FixedArray<FixedArray<long double, size>, size> chebyshev{};
  chebyshev[0][0] = 1;
  chebyshev[1][0] = -1;
  chebyshev[1][1] = 2;
  for (std::size_t m = 1; m + 1 < size; ++m) {
    for (std::size_t i = 0; i < size; ++i) {
      chebyshev[m + 1][i] = (i > 0 ? 4 * chebyshev[m][i - 1] : 0) - 2 * chebyshev[m][i] - chebyshev[m - 1][i];
    }
  }
  for (std::size_t m = size; m-- > Terms;) {
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

}  // namespace splinertia
