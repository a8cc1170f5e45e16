// SPDX-License-Identifier: MIT
/// Numbers as eight bytes in little-endian order on any machine. Compilers turn each function into one instruction.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>

namespace splinertia::detail {

/// Writes eight bytes and returns their end.
inline char* store_little_endian(char* to, std::uint64_t bits) {
  for (int i = 0; i < 8; ++i) to[i] = static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
  return to + 8;
}
inline char* store_little_endian(char* to, std::int64_t value) {
  return store_little_endian(to, static_cast<std::uint64_t>(value));
}
inline char* store_little_endian(char* to, double value) {
  return store_little_endian(to, std::bit_cast<std::uint64_t>(value));
}

/// Reads eight bytes.
template <typename T>
[[nodiscard]] T load_little_endian(const char* from) {
  static_assert(sizeof(T) == 8);
  std::uint64_t bits = 0;
  for (int i = 0; i < 8; ++i) bits |= std::uint64_t{static_cast<unsigned char>(from[i])} << (8 * i);
  return std::bit_cast<T>(bits);
}

}  // namespace splinertia::detail
