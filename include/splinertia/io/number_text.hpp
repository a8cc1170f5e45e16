// SPDX-License-Identifier: MIT
/// Conversion between numbers and decimal text, independent of the locale. Strict: a text has to be a number and
/// nothing else.
#pragma once

#include <charconv>
#include <cstdint>
#include <splinertia/detail/finite.hpp>
#include <splinertia/io/detail/short_decimal.hpp>
#include <string_view>
#include <system_error>
#include <version>

#if !defined(__cpp_lib_to_chars)  // libstdc++ 10, libc++ before 20: no std::from_chars for double
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#if defined(__APPLE__)
#include <xlocale.h>
#endif
#include <algorithm>
#include <string>
#endif

namespace splinertia {

/// The result of parsing a text. `problem` is null if `value` is good; otherwise it completes the sentence `"text" …`.
template <typename T>
struct Parsed {
  T value{};
  const char* problem = nullptr;
};

/// The number of characters for which real_to_chars and integer_to_chars need room.
inline constexpr int number_text_size = 32;

#if !defined(__cpp_lib_to_chars)
namespace detail {

/// The "C" locale, where the decimal point is a point.
[[nodiscard]] inline ::locale_t c_locale() {
  static const ::locale_t locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  return locale;
}

/// Replaces std::from_chars for texts that begin with a digit or point behind an optional minus sign. Looks no further
/// than the next blank or comma.
[[nodiscard]] inline std::from_chars_result real_from_chars(const char* first, const char* last, double& value) {
  last = std::find_if(first, last, [](char c) { return c == ',' || c == ' ' || c == '\t'; });
  const std::string text(first, last);  // strtod wants a terminating zero
  if (text.find_first_of("xX") != std::string::npos) return {first, std::errc::invalid_argument};
  char* end = nullptr;
  value = ::strtod_l(text.c_str(), &end, c_locale());
  return {first + (end - text.c_str()), is_finite(value) ? std::errc{} : std::errc::result_out_of_range};
}

}  // namespace detail

/// Replaces std::to_chars, with 17 digits instead of the fewest.
inline char* real_to_chars(char* first, double value) {
  const ::locale_t before = ::uselocale(detail::c_locale());
  const int length = ::snprintf(first, number_text_size, "%.17g", value);
  ::uselocale(before);
  return first + length;
}
#else
namespace detail {

/// The same as std::from_chars.
[[nodiscard]] inline std::from_chars_result real_from_chars(const char* first, const char* last, double& value) {
#if defined(__SIZEOF_INT128__)
  if (const char* const end = short_decimal(first, last, value)) return {end, std::errc{}};
#endif
  return std::from_chars(first, last, value);
}

}  // namespace detail

/// Writes a double in the fewest digits that read back to the same bits and returns the end of the text.
/// Requires room for number_text_size characters.
inline char* real_to_chars(char* first, double value) {
  return std::to_chars(first, first + number_text_size, value).ptr;
}
#endif

namespace detail {

/// Writes an integer and returns the end of the text. Requires room for number_text_size characters.
inline char* integer_to_chars(char* first, std::int64_t value) {
  return std::to_chars(first, first + number_text_size, value).ptr;
}

/// Whether a text begins as real_from_chars requires: with a digit or point behind an optional minus sign.
[[nodiscard]] inline bool begins_as_real(const char* first, const char* last) {
  if (first != last && *first == '-') ++first;
  return first != last && ((*first >= '0' && *first <= '9') || *first == '.');
}

}  // namespace detail

/// Reads a finite decimal number: digits with an optional sign, point and exponent. Anything else sets `problem`: NaN,
/// infinity, hexadecimal, overflow, anything before or after the number.
[[nodiscard]] inline Parsed<double> parse_real(std::string_view text) {
#if defined(__SIZEOF_INT128__)
  Parsed<double> usual;
  if (!text.empty() &&
      detail::short_decimal(text.data(), text.data() + text.size(), usual.value) == text.data() + text.size()) {
    return usual;
  }
#endif
  const bool plus = text.starts_with('+');  // std::from_chars takes no plus sign
  if (plus) text.remove_prefix(1);
  const std::string_view digits = text.substr(!plus && text.starts_with('-') ? 1 : 0);
  if (digits.starts_with('n') || digits.starts_with('N') || digits.starts_with('i') || digits.starts_with('I')) {
    return {0, "is not a finite number"};
  }
  Parsed<double> number;
  const char* const last = text.data() + text.size();
  const bool begins_well = detail::begins_as_real(text.data(), last) && !(plus && text.starts_with('-'));
  const auto [end, error] = begins_well ? detail::real_from_chars(text.data(), last, number.value)
                                        : std::from_chars_result{text.data(), std::errc::invalid_argument};
  if (error == std::errc::invalid_argument || end != last) {
    number.problem = "is not a number";
  } else if (error != std::errc{}) {
    number.problem = "is out of the range of a double";
  }
  return number;
}

/// Reads a 64-bit integer: digits behind an optional minus sign and nothing else.
[[nodiscard]] inline Parsed<std::int64_t> parse_integer(std::string_view text) {
  Parsed<std::int64_t> number;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number.value);
  if (error == std::errc::invalid_argument || end != last) {
    number.problem = "is not an integer";
  } else if (error != std::errc{}) {
    number.problem = "does not fit in 64 bits";
  }
  return number;
}

}  // namespace splinertia
