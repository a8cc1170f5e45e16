// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <concepts>
#include <type_traits>

namespace splinertia {

/// f(), with all that it calls inlined, and that again.
[[gnu::flatten]] inline auto call_flattened(const auto& f) { return f(); }

/// f(), inlined to the last call where Scalar is a built-in type: compilers give up half-way through the many small
/// functions of a kernel, and then every intermediate value goes through memory, at up to twice the instructions.
/// Scalars of automatic differentiation or multiple precision, each operation of which is a function, are left to the
/// compiler.
template <typename Scalar>
inline auto flattened(const auto& f) {
  if constexpr (std::floating_point<Scalar>) {
    return call_flattened(f);
  } else {
    return f();
  }
}

}  // namespace splinertia
