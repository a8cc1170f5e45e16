// SPDX-License-Identifier: MIT
/// Checks for NaN and infinity that also work under -ffast-math. That option lets compilers remove every comparison and
/// std::isfinite call whose result only a NaN or an infinity could change. They keep tests of the bits.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <bit>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace splinertia::detail {

/// Whether comparisons with NaN are unreliable, because this file is compiled with -ffast-math or a part of it.
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
constexpr bool finite_math_only = true;
#else
constexpr bool finite_math_only = false;
#endif

/// Neither infinite nor NaN, decided by the bits of the exponent. In constant expressions only float and double.
template <std::floating_point T>
[[nodiscard]] constexpr bool has_finite_bits(const T& x) {
  using Limits = std::numeric_limits<T>;
  constexpr int width = std::bit_width(static_cast<unsigned>(Limits::max_exponent));  // bits of the exponent
  if constexpr (sizeof(T) == 4 || sizeof(T) == 8) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    constexpr Bits exponent = ((Bits{1} << width) - 1) << (Limits::digits - 1);
    return (std::bit_cast<Bits>(x) & exponent) != exponent;
  } else {  // x87 (80 bits) or 128 bits: the highest 16 are sign and exponent
    static_assert(width == 15);
    constexpr std::size_t bytes = Limits::digits == 64 ? 10 : sizeof(T);
    constexpr std::size_t highest = std::endian::native == std::endian::little ? bytes - 2 : 0;
    std::uint16_t bits;
    std::memcpy(&bits, reinterpret_cast<const unsigned char*>(&x) + highest, sizeof(bits));
    return (bits & 0x7FFF) != 0x7FFF;
  }
}

/// Neither infinite nor NaN, for any scalar, also in constant expressions.
template <typename T>
[[nodiscard]] constexpr bool is_finite(const T& x) {
  if constexpr (std::floating_point<T> && !finite_math_only) {
    return __builtin_isfinite(x);  // one comparison
  } else if constexpr (std::floating_point<T>) {
    if (!std::is_constant_evaluated()) return has_finite_bits(x);
  }
  return x >= std::numeric_limits<T>::lowest() && x <= (std::numeric_limits<T>::max)();
}

/// Integer durations are always finite.
template <std::integral Ticks, typename Period>
[[nodiscard]] constexpr bool is_finite(const std::chrono::duration<Ticks, Period>&) {
  return true;
}

/// All coefficients of a vector or matrix are finite.
template <typename Matrix>
[[nodiscard]] constexpr bool all_finite(const Matrix& x) {
  for (auto i = x.size(); i-- > 0;) {
    if (!is_finite(x.coeff(i))) return false;
  }
  return true;
}

}  // namespace splinertia::detail
