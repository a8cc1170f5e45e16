// SPDX-License-Identifier: MIT
/// Times as decimal numbers in text, exact to the nanosecond. No double is used, because it could not hold an epoch
/// stamp.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <splinertia/io/number_text.hpp>
#include <string_view>

namespace splinertia {

namespace detail {

/// The parts of a decimal number: digits with at most one point, and the position of the point from the first digit
/// after the exponent has moved it.
struct DecimalText {
  std::string_view mantissa;
  std::int64_t point;
};

/// Splits an unsigned decimal number, plain or with an exponent, into its parts. Anything else sets `problem`.
[[nodiscard]] inline Parsed<DecimalText> scan_decimal(std::string_view text) {
  const Parsed<DecimalText> bad{{}, "is not a number of seconds"};
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::size_t e = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, e);
  const std::size_t point = (std::min)(mantissa.find('.'), mantissa.size());
  const auto digits = static_cast<std::size_t>(std::count_if(mantissa.begin(), mantissa.end(), is_digit));
  if (digits == 0 || digits + (point < mantissa.size() ? 1 : 0) != mantissa.size()) return bad;
  if (e == std::string_view::npos) return {{mantissa, static_cast<std::int64_t>(point)}};

  std::string_view tail = text.substr(e + 1);
  if (tail.starts_with('+') && tail.size() > 1 && is_digit(tail[1])) tail.remove_prefix(1);
  const Parsed<std::int64_t> exponent = parse_integer(tail);
  constexpr std::int64_t limit = 1'000'000;
  if (exponent.problem || exponent.value < -limit || exponent.value > limit) return bad;
  return {{mantissa, static_cast<std::int64_t>(point) + exponent.value}};
}

}  // namespace detail

/// Reads a decimal number in units of 10^-places s, plain (1305031098.6659) or scientific (1.305031098665900000e+09, as
/// numpy.savetxt writes). The result is rounded to the nearest nanosecond, half away from zero. Anything that is not a
/// number or does not fit in 64 bits sets `problem`.
[[nodiscard]] inline Parsed<std::chrono::nanoseconds> parse_time(std::string_view text, int places) {
  const Parsed<std::chrono::nanoseconds> too_large{{}, "does not fit in 64-bit nanoseconds"};
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const Parsed<detail::DecimalText> decimal = detail::scan_decimal(text);
  if (decimal.problem) return {{}, places == 0 ? decimal.problem : "is not a number"};

  // The first `kept` digits are whole nanoseconds, the next one rounds. `count` is ≤ 0, so that it reaches the lowest
  // value.
  constexpr std::int64_t lowest = (std::numeric_limits<std::int64_t>::min)();
  const std::int64_t kept = decimal.value.point + 9 - places;
  std::int64_t count = 0, position = 0;
  for (const char c : decimal.value.mantissa) {
    if (c == '.') continue;
    const int digit = c - '0';
    if (position < kept) {
      if (count < (lowest + digit) / 10) return too_large;
      count = count * 10 - digit;
    } else if (position == kept && digit >= 5) {
      if (count == lowest) return too_large;
      --count;
    }
    ++position;
  }
  for (; position < kept && count != 0; ++position) {
    if (count < lowest / 10) return too_large;
    count *= 10;
  }
  if (!negative && count == lowest) return too_large;
  return {std::chrono::nanoseconds{negative ? count : -count}};
}

namespace detail {

/// Reads decimal seconds as parse_time does.
[[nodiscard]] inline Parsed<std::chrono::nanoseconds> parse_seconds(std::string_view text) {
  return parse_time(text, 0);
}

/// Writes a time as seconds with nine decimals, exactly, and returns the end of the text. Requires room for
/// number_text_size characters.
inline char* seconds_to_chars(char* first, std::chrono::nanoseconds time) {
  constexpr std::int64_t second = 1'000'000'000;
  const std::int64_t whole = time.count() / second;
  std::int64_t fraction = time.count() % second;
  if (time.count() < 0) {
    fraction = -fraction;
    if (whole == 0) *first++ = '-';
  }
  first = integer_to_chars(first, whole);
  *first = '.';
  for (int i = 9; i > 0; --i, fraction /= 10) first[i] = static_cast<char>('0' + fraction % 10);
  return first + 10;
}

}  // namespace detail

}  // namespace splinertia
