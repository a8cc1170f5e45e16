// SPDX-License-Identifier: MIT
/// Comparisons and choices that work on one number and on all lanes of a SIMD pack alike: a kernel written with these
/// has no branches. Both alternatives of select() are computed.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <type_traits>

namespace splinertia::detail {

/// One truth value for each lane of a SimdPack.
template <typename T, int N, int Bytes>
struct SimdMask {
  using Pack = SimdPack<T, N, Bytes>;
  using Vector = decltype(typename Pack::Vector{} < typename Pack::Vector{});

  Vector vector[static_cast<std::size_t>(Pack::vectors)];

  [[nodiscard]] bool operator[](int i) const { return vector[i / Pack::width][i % Pack::width] != 0; }
  friend SimdMask operator&(SimdMask a, const SimdMask& b) {
    for (int i = 0; i < Pack::vectors; ++i) a.vector[i] &= b.vector[i];
    return a;
  }
  friend SimdMask operator|(SimdMask a, const SimdMask& b) {
    for (int i = 0; i < Pack::vectors; ++i) a.vector[i] |= b.vector[i];
    return a;
  }
};

template <typename T>
struct MaskSelector {
  using type = bool;
};
template <typename T, int N, int Bytes>
struct MaskSelector<SimdPack<T, N, Bytes>> {
  using type = SimdMask<T, N, Bytes>;
};

/// What a comparison of T gives: bool, or a SimdMask.
template <typename T>
using Mask = typename MaskSelector<T>::type;

template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Mask<T> less(const T& a, const T& b) {
  if constexpr (is_simd_pack<T>) {
    Mask<T> m;
    for (int i = 0; i < T::vectors; ++i) m.vector[i] = a.vector[i] < b.vector[i];
    return m;
  } else {
    return a < b;
  }
}

/// Both masks are true, without a branch.
template <typename M>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline M both(const M& a, const M& b) {
  return a & b;
}

/// a where the mask is true, else b.
template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T select(const Mask<T>& mask, const T& a, const T& b) {
  if constexpr (is_simd_pack<T>) {
    T x;
    for (int i = 0; i < T::vectors; ++i) x.vector[i] = mask.vector[i] ? a.vector[i] : b.vector[i];
    return x;
  } else {
    return mask ? a : b;
  }
}

template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T magnitude(const T& x) {
  if constexpr (is_simd_pack<T>) {
    return select<T>(less(x, T(0)), -x, x);
  } else {
    using std::abs;
    return abs(x);
  }
}

template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T larger(const T& a, const T& b) {
  return select<T>(less(a, b), b, a);
}

template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T square_root(const T& x) {
  if constexpr (is_simd_pack<T>) {
    T y;
    using Lanes = Eigen::Array<std::remove_cvref_t<decltype(x.vector[0][0])>, T::width, 1>;
    for (int i = 0; i < T::vectors; ++i) {
      Lanes lanes;
      std::memcpy(lanes.data(), &x.vector[i], sizeof(x.vector[i]));
      lanes = lanes.sqrt().eval();
      std::memcpy(&y.vector[i], lanes.data(), sizeof(x.vector[i]));
    }
    return y;
  } else {
    using std::sqrt;
    return sqrt(x);
  }
}

/// Neither infinite nor NaN, in each lane.
template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Mask<T> finite_lanes(const T& x) {
  if constexpr (is_simd_pack<T>) {
    Mask<T> m;
    for (int i = 0; i < T::vectors; ++i) {
      using Bits = typename Mask<T>::Vector;
      using Word = std::remove_cvref_t<decltype(Bits{}[0])>;
      constexpr int digits = std::numeric_limits<T>::digits;
      const Bits exponent = Bits{} + (((Word{1} << (static_cast<int>(sizeof(Word)) * 8 - digits)) - 1) << (digits - 1));
      m.vector[i] = (reinterpret_cast<Bits>(x.vector[i]) & exponent) != exponent;
    }
    return m;
  } else {
    return is_finite(x);
  }
}

}  // namespace splinertia::detail
