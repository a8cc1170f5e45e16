// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <random>
#include <splinertia/io/seconds_text.hpp>
#include <string>
#include <string_view>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

std::int64_t ns(std::string_view text) {
  const Parsed<nanoseconds> parsed = parse_seconds(text);
  CAPTURE(text);
  REQUIRE(parsed.problem == nullptr);
  return parsed.value.count();
}

std::string problem_of(std::string_view text) {
  const char* problem = parse_seconds(text).problem;
  return problem ? problem : "";
}

std::string text_of(std::int64_t count) {
  std::array<char, number_text_size> text;
  return {text.data(), seconds_to_chars(text.data(), nanoseconds{count})};
}

constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();

}  // namespace

TEST_CASE("decimal seconds are read to the nanosecond") {
  CHECK(ns("1305031098.6659") == 1305031098665900000);
  CHECK(ns("1403715524.907143168") == 1403715524907143168);
  CHECK(ns("0") == 0);
  CHECK(ns("12") == 12'000'000'000);
  CHECK(ns("12.") == 12'000'000'000);
  CHECK(ns(".5") == 500'000'000);
  CHECK(ns("+1.5") == 1'500'000'000);
  CHECK(ns("-0.000000001") == -1);
  CHECK(ns("0000000000000000000000001.5") == 1'500'000'000);
  CHECK(ns("9223372036.854775807") == highest);
  CHECK(ns("-9223372036.854775808") == lowest);
}

TEST_CASE("and so is scientific notation") {
  CHECK(ns("1.305031098665900000e+09") == 1305031098665900000);
  CHECK(ns("1.403715524907143168e9") == 1403715524907143168);
  CHECK(ns("0.000000000000000000e+00") == 0);
  CHECK(ns("0e999") == 0);
  CHECK(ns("5E-3") == 5'000'000);
  CHECK(ns("15e-10") == 2);
  CHECK(ns("123456.789e-4") == 12'345'678'900);
  CHECK(ns("1e-400") == 0);
  CHECK(ns("-9.223372036854775808e+09") == lowest);
  CHECK(ns("1e9") == 1'000'000'000'000'000'000);
}

TEST_CASE("half a nanosecond is rounded away from zero") {
  CHECK(ns("0.0000000005") == 1);
  CHECK(ns("-0.0000000005") == -1);
  CHECK(ns("0.00000000049999999999") == 0);
  CHECK(ns("1.0000000014999") == 1'000'000'001);
  CHECK(ns("0.9999999995") == 1'000'000'000);
  CHECK(ns("5e-10") == 1);
  CHECK(ns("5e-11") == 0);
  CHECK(ns("9223372036.8547758074") == highest);
  CHECK(problem_of("9223372036.8547758075") == "does not fit in 64-bit nanoseconds");
}

TEST_CASE("seconds that are none, or too many") {
  for (const char* text : {"",     "-",     "+",   ".",   "-.",    "abc",  "1.5s",
                           "1..5", "1.5.5", "1e",  "1e+", "1e+-3", "1e 3", " 1",
                           "1 ",   "nan",   "inf", "0x1", "e5",    "+-1",  "1e99999999999999999999",
                           "1,5"}) {
    CAPTURE(text);
    CHECK(problem_of(text) == "is not a number of seconds");
  }
  for (const char* text : {"9223372036.854775808", "-9223372036.854775809", "1403715524907143168", "1e300", "-1e10"}) {
    CAPTURE(text);
    CHECK(problem_of(text) == "does not fit in 64-bit nanoseconds");
  }
}

TEST_CASE("seconds are written with nine decimals and read back") {
  CHECK(text_of(0) == "0.000000000");
  CHECK(text_of(1403715524907143168) == "1403715524.907143168");
  CHECK(text_of(-1) == "-0.000000001");
  CHECK(text_of(-1'500'000'000) == "-1.500000000");
  CHECK(text_of(lowest) == "-9223372036.854775808");
  std::mt19937_64 random(2);
  for (int i = 0; i < 10'000; ++i) {
    const auto count = static_cast<std::int64_t>(random()) >> (i % 64);
    REQUIRE(ns(text_of(count)) == count);
  }
}
