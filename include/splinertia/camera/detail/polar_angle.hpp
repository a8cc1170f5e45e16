// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/select.hpp>
#include <splinertia/group/detail/economized_series.hpp>
#include <splinertia/group/detail/stumpff.hpp>
#include <type_traits>

namespace splinertia::detail {

/// tan(π/8)², the end of the interval of the series of atan(q)/q in q².
inline constexpr long double arctangent_reach = 0.171572875253809902396622551580603843L;

/// The number of terms whose error is below `bound`. The coefficients in Chebyshev polynomials on [0, reach] fall
/// 25-fold from one to the next, because the nearest singularity of the series is at q² = −1.
[[nodiscard]] constexpr int arctangent_terms(long double bound) {
  int terms = 1;
  for (long double error = 1; error > bound; error /= 25) ++terms;
  return terms;
}

/// The polynomial of Terms terms that approximates (atan(√x)/√x − 1)/x on [0, reach].
template <typename Real, int Terms>
[[nodiscard]] constexpr FixedArray<Real, Terms> arctangent_series() {
  FixedArray<long double, Terms + 16> b{};
  long double power = -1, odd = 3;
  for (long double& coefficient : b) {
    coefficient = power / odd;
    power *= -arctangent_reach;
    odd += 2;
  }
  return economized<Real, Terms>(b, arctangent_reach);
}

/// atan2(r, z) for r ≥ 0, not both zero: the angle between the z axis and a point at the distance r from it, in [0, π].
/// Relative error at most 2 eps. For SIMD packs it has no branches; scalars other than float and double use
/// their own atan2.
template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T polar_angle(const T& r, const T& z) {
  if constexpr (is_simd_pack<T> || std::same_as<T, float> || std::same_as<T, double>) {
    using Real =
        std::conditional_t<std::numeric_limits<T>::digits == std::numeric_limits<float>::digits, float, double>;
    constexpr int terms = arctangent_terms(static_cast<long double>(std::numeric_limits<Real>::epsilon()) / 8) - 1;
    constexpr auto series = arctangent_series<Real, terms>();
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
    const T q = n / d, x = q * q, angle = o + (q + q * (x * polynomial(series, x)));
    return select<T>(less(z, T(0)), T(pi) - angle, angle);
  } else {
    using std::atan2;
    return atan2(r, z);
  }
}

}  // namespace splinertia::detail
