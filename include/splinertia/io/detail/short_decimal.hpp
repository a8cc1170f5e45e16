// SPDX-License-Identifier: MIT
/// Parses decimal numbers of usual length by integer arithmetic: twice as fast as std::from_chars of libstdc++.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace splinertia::detail {

#if defined(__SIZEOF_INT128__)

__extension__ using Wide = unsigned __int128;

/// The powers of five that 64 bits hold.
inline constexpr auto powers_of_five = [] {
  std::array<std::uint64_t, 28> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 5 * powers[i - 1];
  return powers;
}();

/// ⌊2^127/d⌋ for each power of five, d, shifted to the upper end of 64 bits.
inline constexpr auto reciprocals_of_powers = [] {
  std::array<std::uint64_t, powers_of_five.size()> reciprocals{};
  for (std::size_t i = 0; i < reciprocals.size(); ++i) {
    const Wide largest = ~Wide{0} >> 1;  // as good as 2^127, which only the unused d of i = 0 divides
    reciprocals[i] = static_cast<std::uint64_t>(largest / (powers_of_five[i] << std::countl_zero(powers_of_five[i])));
  }
  return reciprocals;
}();

/// digits·10^power, rounded to the nearest double, ties to even. Requires |power| ≤ 27. Product and quotient are exact
/// integers. What does not fit in 64 bits only sets the last of these bits, which is enough for the rounding.
[[nodiscard]] inline double decimal_value(std::uint64_t digits, int power) {
  if (digits == 0) return 0;
  const auto index = static_cast<std::size_t>(power < 0 ? -power : power);
  const std::uint64_t factor = powers_of_five[index];
  const int free = std::countl_zero(digits);
  const std::uint64_t normal = digits << free;
  std::uint64_t bits = 0;
  bool inexact = true;
  int exponent = power - free;  // the value is bits·2^exponent
  if (power < 0) {
    const int free_of_factor = std::countl_zero(factor);
    exponent += free_of_factor - 63;
    // The exact quotient exceeds this by less than 2. A double keeps 53 of its 63 or 64 bits. The rounding can
    // therefore depend on the difference only if the last 9 bits are nearly zero.
    bits = static_cast<std::uint64_t>(static_cast<Wide>(normal) * reciprocals_of_powers[index] >> 64);
    if (((bits + 2) & 0x1FF) <= 2) {
      const std::uint64_t divisor = factor << free_of_factor;
      const Wide dividend = static_cast<Wide>(normal) << 63;  // its upper half is less than the divisor
      bits = static_cast<std::uint64_t>(dividend / divisor);
      inexact = bits * divisor != static_cast<std::uint64_t>(dividend);
    }
  } else {
    const Wide product = static_cast<Wide>(normal) * factor;
    const auto bits_of_factor = static_cast<int>(std::bit_width(factor));
    bits = static_cast<std::uint64_t>(product >> bits_of_factor);
    inexact = (static_cast<Wide>(bits) << bits_of_factor) != product;
    exponent += bits_of_factor;
  }
  bits = bits >> 1 | (bits & 1) | (inexact ? 1 : 0);
  const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1 + 1023) << 52);  // a power of two
  return static_cast<double>(static_cast<std::int64_t>(bits)) * scale;
}

inline constexpr std::uint64_t ascii_zeros = 0x3030303030303030;

/// The number with these 8 digits, a byte of 0 to 9 each. The first digit is the lowest byte.
[[nodiscard]] inline std::uint64_t eight_digits(std::uint64_t bytes) {
  bytes = (bytes * 10 + (bytes >> 8)) & 0x00FF00FF00FF00FF;
  bytes = (bytes * 100 + (bytes >> 16)) & 0x0000FFFF0000FFFF;
  return (bytes * 10000 + (bytes >> 32)) & 0x00000000FFFFFFFF;
}

/// Has bits set in the bytes that are not ASCII digits; correct up to the first such byte.
[[nodiscard]] inline std::uint64_t non_digits(std::uint64_t bytes) {
  // A digit has 3 in its upper half, before and after 6 is added. A carry reaches only bytes behind a non-digit.
  constexpr std::uint64_t sixes = 0x0606060606060606, upper = 0xF0F0F0F0F0F0F0F0;
  return ((bytes ^ ascii_zeros) | ((bytes + sixes) ^ ascii_zeros)) & upper;
}

/// Appends the digits from `first` on to a number, modulo 2^64, and returns where they end. The text begins at `begin`.
[[nodiscard]] inline const char* append_digits(const char* begin, const char* first, const char* last,
                                               std::uint64_t& number) {
  if constexpr (std::endian::native == std::endian::little) {
    std::uint64_t bytes = 0;
    for (; last - first >= 8; first += 8) {
      std::memcpy(&bytes, first, 8);
      if (non_digits(bytes) != 0) break;
      number = number * 100'000'000 + eight_digits(bytes ^ ascii_zeros);
    }
    if (last - begin >= 8) {
      // Near the end the 8 bytes begin earlier, and those before `first` are shifted out, in two steps because a shift
      // by 64 is undefined.
      const std::ptrdiff_t left = std::min<std::ptrdiff_t>(8, last - first);
      std::memcpy(&bytes, first + left - 8, 8);
      bytes = bytes >> (4 * (8 - left)) >> (4 * (8 - left));
      const int digits = std::countr_zero(non_digits(bytes)) / 8;
      constexpr std::array<std::uint64_t, 8> powers{1, 10, 100, 1000, 10'000, 100'000, 1'000'000, 10'000'000};
      const std::uint64_t values = (bytes ^ ascii_zeros) << (4 * (8 - digits)) << (4 * (8 - digits));
      number = number * powers[static_cast<std::size_t>(digits)] + eight_digits(values);
      return first + digits;
    }
  }
  for (; first != last && *first >= '0' && *first <= '9'; ++first) {
    number = number * 10 + static_cast<std::uint64_t>(*first - '0');
  }
  return first;
}

/// The number of leading zeros among the first 8 characters of a decimal number whose point is behind `integers`
/// digits. It has no branch, since the numbers of a table differ in this.
[[nodiscard]] inline std::ptrdiff_t leading_zeros(const char* first, std::ptrdiff_t integers) {
  if constexpr (std::endian::native != std::endian::little) return 0;  // then std::from_chars reads more numbers
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, first, 8);
  bytes ^= ascii_zeros;
  if (integers < 8) bytes &= ~(std::uint64_t{0xFF} << (8 * integers));
  const std::ptrdiff_t leading = std::countr_zero(bytes) / 8;
  return leading - (leading > integers ? 1 : 0);
}

/// Reads the decimal number at the beginning of a text as std::from_chars does, and returns its end. Returns null if it
/// has to be read by std::from_chars: more than 19 digits, a power of ten beyond ±27, or not a number.
[[nodiscard]] inline const char* short_decimal(const char* first, const char* last, double& value) {
  if (first == last) return nullptr;
  const std::ptrdiff_t sign = *first == '-' ? 1 : 0;
  const char* const begin = first + sign;
  std::uint64_t number = 0;
  const char* end = begin;  // usually one digit: not worth append_digits
  for (; end != last && *end >= '0' && *end <= '9'; ++end)
    number = number * 10 + static_cast<std::uint64_t>(*end - '0');
  std::ptrdiff_t digits = end - begin, decimals = 0;
  if (end != last && *end == '.') {
    const char* const point = end++;
    end = append_digits(first, end, last, number);
    decimals = end - point - 1;
    digits += decimals;
  }
  if (digits == 0) return nullptr;

  const std::ptrdiff_t zeros = last - begin >= 8 ? leading_zeros(begin, digits - decimals) : 0;
  if (digits - zeros > std::numeric_limits<std::uint64_t>::digits10) return nullptr;
  std::ptrdiff_t power = -decimals;
  if (end != last && (*end == 'e' || *end == 'E')) {
    const char* const sign_of_power = end + 1;
    const bool has_sign = sign_of_power != last && (*sign_of_power == '-' || *sign_of_power == '+');
    const char* const exponent = sign_of_power + (has_sign ? 1 : 0);
    int amount = 0;
    for (end = exponent; end != last && *end >= '0' && *end <= '9' && end - exponent < 4; ++end) {
      amount = amount * 10 + (*end - '0');
    }
    if (end == exponent || end - exponent > 3) return nullptr;
    power += has_sign && *sign_of_power == '-' ? -amount : amount;
  }
  constexpr auto most = static_cast<std::ptrdiff_t>(powers_of_five.size()) - 1;
  if (power < -most || power > most) return nullptr;
  // No branch, since signs are random.
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(decimal_value(number, static_cast<int>(power))) |
                                static_cast<std::uint64_t>(sign) << 63);
  return end;
}

#endif

}  // namespace splinertia::detail
