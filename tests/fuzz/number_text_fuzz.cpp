// SPDX-License-Identifier: MIT
// Any text as a number or a time, held against the C library's reading of it; any number as text.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <string>
#include <string_view>

#include "fuzz/fuzz.hpp"

namespace splinertia::fuzz::number_text_target {

using namespace splinertia::detail;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void expect_round_trip(double value) {
  char text[number_text_size];
  const std::string_view written(text, static_cast<std::size_t>(real_to_chars(text, value) - text));
  const Parsed<double> again = parse_real(written);
  expect(again.problem == nullptr && bits(again.value) == bits(value), "wrote ", written);
}

void expect_number(const std::string& text) {
  const Parsed<double> number = parse_real(text);
  const bool decimal = text.find_first_not_of("0123456789+-.eE") == std::string::npos;
  char* end = nullptr;
  const double expected = std::strtod(text.c_str(), &end);
  const bool whole = decimal && !text.empty() && end == text.c_str() + text.size();
  if (number.problem) {
    // What is too small for a normal number may be refused.
    const bool in_range = std::abs(expected) >= std::numeric_limits<double>::min() && std::isfinite(expected);
    expect(!whole || !in_range, "refused ", text, ", which ", number.problem);
  } else {
    expect(whole && bits(number.value) == bits(expected), "read ", text, " as ", number.value);
    expect_round_trip(number.value);
  }
}

void expect_time(const std::string& text, int places) {
  const auto time = parse_time(text, places);
  if (time.problem) return;
  const long double count = std::strtold(text.c_str(), nullptr) * std::pow(10.0L, 9 - places);
  expect(std::abs(static_cast<long double>(time.value.count()) - count) <= 0.5L + std::abs(count) * 1e-18L, "read ",
         text, " as ", time.value.count(), " ns");
  char again[number_text_size];
  const std::string_view written(again, static_cast<std::size_t>(seconds_to_chars(again, time.value) - again));
  const auto same = parse_seconds(written);
  expect(same.problem == nullptr && same.value == time.value, "wrote ", written);
}

const Target target{"number_text", [](Input input) {
                      const int places = 3 * input.integer(0, 3);
                      const double value = Input(input).bits<double>();
                      if (has_finite_bits(value)) expect_round_trip(value);
                      const std::string text(input.rest().substr(0, 100));
                      if (text.find('\0') != text.npos) return;
                      expect_number(text);
                      expect_time(text, places);
                    }};

}  // namespace splinertia::fuzz::number_text_target
