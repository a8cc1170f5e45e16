// SPDX-License-Identifier: MIT
/// Streams of random numbers that are the same everywhere. A stream is named by its purpose, so that the order of use
/// does not matter.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <splinertia/detail/inline.hpp>
#include <string_view>

namespace splinertia {

/// The requirements of std::uniform_random_bit_generator, without including <random>.
template <typename G>
concept BitGenerator = std::move_constructible<G> && std::unsigned_integral<std::invoke_result_t<G&>> &&
                       requires { requires(G::min)() < (G::max)(); };

namespace detail {

/// Scrambles 64 bits: every bit of the result depends on every bit of x. The finaliser of SplitMix64: Steele, Lea,
/// Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014, with Stafford's constants (variant 13).
[[nodiscard]] constexpr std::uint64_t scramble(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace detail

/// The name of a stream of random numbers, one for each run (seed), sensor, error term and axis. Streams with different
/// names are independent: adding a term or a sensor leaves the numbers of all others unchanged.
class StreamKey {
 public:
  constexpr explicit StreamKey(std::uint64_t seed) : hash_(detail::scramble(seed + golden_ratio)) {}

  /// The key of part `index` of what this key names.
  [[nodiscard]] constexpr StreamKey operator/(std::uint64_t index) const {
    return StreamKey(Hash{detail::scramble(hash_ + golden_ratio * (2 * index + 1))});
  }
  /// The key of the part called `name`.
  [[nodiscard]] constexpr StreamKey operator/(std::string_view name) const {
    std::uint64_t index = name.size();
    for (const char c : name) index = detail::scramble(index ^ static_cast<unsigned char>(c));
    return *this / index;
  }
  [[nodiscard]] constexpr std::uint64_t hash() const { return hash_; }

 private:
  struct Hash {
    std::uint64_t value;
  };
  static constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;
  constexpr explicit StreamKey(Hash hash) : hash_(hash.value) {}
  std::uint64_t hash_;
};

/// xoshiro256++, period 2²⁵⁶ − 1; a std::uniform_random_bit_generator.
/// Blackman, Vigna, "Scrambled Linear Pseudorandom Number Generators", ACM TOMS 47 (2021).
class Xoshiro256 {
 public:
  using result_type = std::uint64_t;

  constexpr explicit Xoshiro256(StreamKey key) {
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = (key / i).hash();
  }
  static constexpr result_type(min)() { return 0; }
  static constexpr result_type(max)() { return (std::numeric_limits<result_type>::max)(); }

  SPLINERTIA_ALWAYS_INLINE constexpr result_type operator()() {
    auto& [a, b, c, d] = state_;
    const std::uint64_t result = std::rotl(a + d, 23) + a;
    const std::uint64_t t = b << 17;
    c ^= a;
    d ^= b;
    b ^= c;
    a ^= d;
    c ^= t;
    d = std::rotl(d, 45);
    return result;
  }

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace splinertia
