// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/select.hpp>
#include <type_traits>

namespace splinertia::detail {

/// Below this |m|² has lost digits by underflow, and every distortion is negligible beside m.
template <typename Scalar>
[[nodiscard]] constexpr Scalar smallest_square() {
  return (std::numeric_limits<Scalar>::min)() / std::numeric_limits<Scalar>::epsilon();
}

/// A power of two that brings the largest of |x|, |y|, |z| into [1, 4). With it, squares neither overflow nor
/// underflow, and nothing is rounded. NaN and infinity give some power of two. For scalars other than the built-in
/// types it is 1.
template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T direction_scale(const T& x, const T& y, const T& z) {
  if constexpr (is_simd_pack<T>) {
    const T largest = larger(larger(magnitude(x), magnitude(y)), magnitude(z));
    T scale;
    for (int i = 0; i < T::vectors; ++i) {
      using Vector = typename T::Vector;
      using Bits = typename Mask<T>::Vector;
      using Word = std::remove_cvref_t<decltype(Bits{}[0])>;
      constexpr int digits = std::numeric_limits<T>::digits;
      constexpr Word one = Word{1} << (digits - 1),
                     all = (Word{1} << (static_cast<int>(sizeof(Word)) * 8 - digits)) - 1;
      const Bits exponent = reinterpret_cast<Bits>(largest.vector[i]) & (Bits{} + all * one);
      const Bits quotient = (Bits{} + (all - 1) * one) - exponent;
      scale.vector[i] = reinterpret_cast<Vector>(quotient + ((quotient == Bits{}) & (Bits{} + one)));
    }
    return scale;
  } else if constexpr (std::same_as<T, float> || std::same_as<T, double>) {
    using Bits = std::conditional_t<std::same_as<T, float>, std::uint32_t, std::uint64_t>;
    constexpr int digits = std::numeric_limits<T>::digits;
    constexpr Bits one = Bits{1} << (digits - 1);
    constexpr Bits all = (Bits{1} << (static_cast<int>(sizeof(T)) * 8 - digits)) - 1;
    const T largest = larger(larger(magnitude(x), magnitude(y)), magnitude(z));
    const Bits exponent = std::bit_cast<Bits>(largest) & (all * one);
    const Bits quotient = (all - 1) * one - exponent;
    return std::bit_cast<T>(quotient == 0 ? one : quotient);
  } else if constexpr (std::floating_point<T>) {
    int exponent = 0;
    (void)std::frexp((std::max)({std::abs(x), std::abs(y), std::abs(z)}), &exponent);
    return std::ldexp(T(1), 1 - (std::max)(exponent, 3 - std::numeric_limits<T>::max_exponent));
  } else {
    return T(1);
  }
}

}  // namespace splinertia::detail
