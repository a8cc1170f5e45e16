// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <concepts>
#include <type_traits>

namespace splinertia::detail {

/// f(), with all calls inlined, at every depth.
[[gnu::flatten]] inline auto call_flattened(const auto& f) { return f(); }

/// f(), with all calls inlined at every depth if Scalar is a built-in type. Otherwise compilers stop half-way through
/// the many small functions of a kernel; every intermediate value then goes through memory, at up to twice the
/// instructions. For scalars of automatic differentiation or multiple precision, each operation of which is a function,
/// inlining is left to the compiler.
template <typename Scalar>
inline auto flattened(const auto& f) {
  if constexpr (std::floating_point<Scalar>) {
    return call_flattened(f);
  } else {
    return f();
  }
}

}  // namespace splinertia::detail
