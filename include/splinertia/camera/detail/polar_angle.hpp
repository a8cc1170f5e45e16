// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/select.hpp>
#include <type_traits>
#include <utility>

namespace splinertia::detail {

/// tan(π/8)², the end of the interval of the series of atan(q)/q in q².
inline constexpr long double arctangent_reach = 0.171572875253809902396622551580603843L;

/// The number of terms whose error is below `bound`. The coefficients in Chebyshev polynomials on [0, reach] fall
/// 25-fold from one to the next, because the nearest singularity of the series is at q² = −1.
[[nodiscard]] constexpr std::size_t arctangent_terms(long double bound) {
  std::size_t terms = 1;
  for (long double error = 1; error > bound; error /= 25) ++terms;
  return terms;
}

/// The coefficients a of the polynomial Σ a[m] x^m that interpolates atan(√x)/√x in the zeros of the Chebyshev
/// polynomial on [0, reach], made from the Taylor series by removing its highest terms (Lanczos, "Applied Analysis"
/// (1956), VII.6).
template <typename Real, std::size_t Terms>
[[nodiscard]] constexpr std::array<Real, Terms> arctangent_series() {
  constexpr std::size_t size = Terms + 16;
  std::array<long double, size> b{};
  long double power = 1;
  for (std::size_t m = 0; m < size; ++m, power *= -arctangent_reach) b[m] = power / static_cast<long double>(2 * m + 1);
  std::array<std::array<long double, size>, size> chebyshev{};  // T*_{m+1} = (4y − 2) T*_m − T*_{m−1}
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
  std::array<Real, Terms> a{};
  long double scale = 1;
  for (std::size_t m = 0; m < Terms; ++m, scale /= arctangent_reach) a[m] = static_cast<Real>(b[m] * scale);
  return a;
}

/// atan2(r, z) for r ≥ 0, not both zero: the angle between the z axis and a point at the distance r from it, in [0, π].
/// Relative error at most 2 eps. For SIMD packs it has no branches; scalars other than float and double use
/// their own atan2.
template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T polar_angle(const T& r, const T& z) {
  if constexpr (is_simd_pack<T> || std::same_as<T, float> || std::same_as<T, double>) {
    using Real =
        std::conditional_t<std::numeric_limits<T>::digits == std::numeric_limits<float>::digits, float, double>;
    constexpr std::size_t terms = arctangent_terms(static_cast<long double>(std::numeric_limits<Real>::epsilon()) / 8);
    constexpr std::array<Real, terms> a = arctangent_series<Real, terms>();
    constexpr Real pi = pi_of<Real>(), tangent = static_cast<Real>(0.414213562373095048801688724209698079L);  // tan π/8
    // atan(r/h) = o + atan(n/d) with |n/d| ≤ tan π/8.
    const T h = magnitude(z);
    T n, d, o;
    if constexpr (is_simd_pack<T>) {
      const Mask<T> low = less<T>(r, tangent * h), high = less<T>(h, tangent * r);
      n = select<T>(low, r, select<T>(high, -h, r - h));
      d = select<T>(low, h, select<T>(high, r, r + h));
      o = select<T>(low, T(0), select<T>(high, T(pi / 2), T(pi / 4)));
    } else if (r < tangent * h) {
      n = r, d = h, o = T(0);
    } else if (h < tangent * r) {
      n = -h, d = r, o = pi / 2;
    } else {
      n = r - h, d = r + h, o = pi / 4;
    }
    const T q = n / d, x = q * q, y = x * x;
    T even(a[(terms - 1) / 2 * 2]), odd(a[(terms - 2) / 2 * 2 + 1]);
    for (std::size_t m = (terms - 1) / 2; m-- > 0;) even = even * y + T(a[2 * m]);
    for (std::size_t m = (terms - 2) / 2; m-- > 0;) odd = odd * y + T(a[2 * m + 1]);
    // a[0] is 1 to rounding: q itself is added last.
    const T angle = o + (q + q * ((even - T(1)) + x * odd));
    return select<T>(less(z, T(0)), T(pi) - angle, angle);
  } else {
    using std::atan2;
    return atan2(r, z);
  }
}

}  // namespace splinertia::detail
