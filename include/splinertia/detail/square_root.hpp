// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstring>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <type_traits>

namespace splinertia::detail {

/// √x as a single instruction, of a number or of the lanes of a SIMD pack. std::sqrt may set errno, which keeps compilers
/// from computing it once before a loop.
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
  } else if constexpr (std::floating_point<T>) {
    return Eigen::Array<T, 2, 1>::Constant(x).sqrt().eval().x();
  } else {
    using std::sqrt;
    return sqrt(x);
  }
}

}  // namespace splinertia::detail
