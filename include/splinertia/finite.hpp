// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <splinertia/time.hpp>

namespace splinertia {

/// Neither infinite nor NaN, for any scalar, also while compiling; integer times are always finite.
template <typename T>
[[nodiscard]] constexpr bool is_finite(const T& x) {
  if constexpr (is_integer_duration<T>) {
    return true;
  } else {
    return x >= std::numeric_limits<T>::lowest() && x <= std::numeric_limits<T>::max();
  }
}

}  // namespace splinertia
