// SPDX-License-Identifier: MIT
/// Counts what a program allocates, in operator new, and has Eigen refuse to allocate. For one source file of a
/// program, whose first line besides comments is #define EIGEN_RUNTIME_NO_MALLOC.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace splinertia::testing {

inline std::size_t allocations = 0;

/// How often work() allocates.
inline std::size_t allocations_of(const auto& work) {
  Eigen::internal::set_is_malloc_allowed(false);
  const std::size_t before = allocations;
  work();
  const std::size_t after = allocations;
  Eigen::internal::set_is_malloc_allowed(true);
  return after - before;
}

}  // namespace splinertia::testing

// Not inlined: g++ would see free() of what another operator new may have made, and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++splinertia::testing::allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// With a sanitizer the one that does not throw is not made of it.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++splinertia::testing::allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
