// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <splinertia/detail/inline.hpp>
#include <splinertia/random/random_stream.hpp>
#include <type_traits>

namespace splinertia::detail {

/// 64 random bits at a time, from any uniform random bit generator that can be moved and seeded. The seed is the key
/// itself if the generator takes one. Else it is the key's hash, as for the engines of <random> (those with 32-bit
/// seeds use half of it). The bits of narrower generators are concatenated; values beyond the largest power of two in
/// their range are drawn again.
template <BitGenerator Generator = Xoshiro256>
class RandomBits {
 public:
  constexpr explicit RandomBits(StreamKey key) : generator_(make(key)) {}

  SPLINERTIA_ALWAYS_INLINE constexpr std::uint64_t operator()() {
    if constexpr (bits >= 64) {
      return static_cast<std::uint64_t>(generator_());
    } else {
      std::uint64_t result = 0;
      for (int filled = 0; filled < 64; filled += bits) result = (result << bits) | some();
      return result;
    }
  }

 private:
  using Result = std::invoke_result_t<Generator&>;
  static constexpr std::uint64_t range = static_cast<std::uint64_t>((Generator::max)() - (Generator::min)());
  static constexpr int bits = range == (std::numeric_limits<std::uint64_t>::max)() ? 64 : std::bit_width(range + 1) - 1;

  static constexpr Generator make(StreamKey key) {
    if constexpr (std::constructible_from<Generator, StreamKey>) {
      return Generator(key);
    } else {
      static_assert(std::constructible_from<Generator, Result>,
                    "the generator must be seeded: make it constructible from a StreamKey or an integer");
      return Generator(static_cast<Result>(key.hash()));
    }
  }

  constexpr std::uint64_t some() {
    while (true) {
      const auto value = static_cast<std::uint64_t>(generator_() - (Generator::min)());
      if (value >> bits == 0) return value;
    }
  }

  Generator generator_;
};

}  // namespace splinertia::detail
