// SPDX-License-Identifier: MIT
#include <array>
#include <bit>
#include <clocale>
#include <cstdint>
#include <limits>
#include <random>
#include <splinertia/io/number_text.hpp>
#include <string>
#include <string_view>
#include <system_error>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

std::string text_of(double value) {
  std::array<char, number_text_size> text;
  return {text.data(), real_to_chars(text.data(), value)};
}

// The text is a view of something longer, as it is in a line.
std::string problem_of(std::string_view text) {
  const std::string line = std::string(text) + "1";
  const Parsed<double> parsed = parse_real(std::string_view(line).substr(0, text.size()));
  return parsed.problem ? parsed.problem : "";
}

void check_round_trip(double value) {
  const Parsed<double> parsed = parse_real(text_of(value));
  CAPTURE(value);
  REQUIRE(parsed.problem == nullptr);
  REQUIRE(std::bit_cast<std::uint64_t>(parsed.value) == std::bit_cast<std::uint64_t>(value));
}

}  // namespace

TEST_CASE("doubles read back to the same bits") {
  using Limits = std::numeric_limits<double>;
  for (const double value :
       {0.0, -0.0, 1.0, 0.1, -1.0 / 3, Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min(),
        -Limits::denorm_min(), 5e22, 9007199254740993.0, 2.2250738585072011e-308}) {
    check_round_trip(value);
  }
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (value >= Limits::lowest() && value <= Limits::max()) check_round_trip(value);
  }
}

TEST_CASE("numbers are read as people and programs write them") {
  CHECK(parse_real("12").value == 12);
  CHECK(parse_real("+1.5").value == 1.5);
  CHECK(parse_real("-.5").value == -0.5);
  CHECK(parse_real("5.").value == 5);
  CHECK(parse_real("1.305031098665900000e+09").value == 1305031098.6659);
  CHECK(parse_real("-1E-3").value == -0.001);
}

TEST_CASE("what is no finite number has a problem") {
  for (const char* text : {"", "-", "+", ".", "abc", "1.0x", "1 ", " 1", "1,0", "--1", "+-1", "-+1", "++1", "0x10",
                           "0x1p3", "1e", "e5", "1.2.3", "1e5.5"}) {
    CAPTURE(text);
    CHECK(problem_of(text) == "is not a number");
  }
  for (const char* text : {"nan", "-nan", "NaN", "+NAN", "inf", "-Inf", "INFINITY", "nan(1)"}) {
    CAPTURE(text);
    CHECK(problem_of(text) == "is not a finite number");
  }
  CHECK(problem_of("1e999") == "is out of the range of a double");
  CHECK(problem_of("-1e309") == "is out of the range of a double");
}

TEST_CASE("a real number begins with a digit or point behind an optional minus sign") {
  const auto begins = [](std::string_view text) { return begins_as_real(text.data(), text.data() + text.size()); };
  for (const char* text : {"0", "9x", "-1", ".5", "-.5"}) CHECK(begins(text));
  for (const char* text : {"", "-", "+1", "--1", "nan", "-inf", " 1", ",", "x"}) CHECK_FALSE(begins(text));
}

TEST_CASE("a real number ends at the next comma or blank") {
  for (const std::string_view text : {"-1.5,2", "-1.5 2", "-1.5\t0x", "-1.5"}) {
    double value = 0;
    const auto [end, error] = real_from_chars(text.data(), text.data() + text.size(), value);
    CHECK(error == std::errc{});
    CHECK(end == text.data() + 4);
    CHECK(value == -1.5);
  }
}

TEST_CASE("integers are exact and strict") {
  CHECK(parse_integer("1403715524907143168").value == 1403715524907143168);
  CHECK(parse_integer("-9223372036854775808").value == std::numeric_limits<std::int64_t>::min());
  CHECK(parse_integer("9223372036854775807").problem == nullptr);
  CHECK(std::string(parse_integer("9223372036854775808").problem) == "does not fit in 64 bits");
  for (const char* text : {"", "-", "1.5", "1e18", "12a", "+1", " 1", "0x1"}) {
    CAPTURE(text);
    REQUIRE(parse_integer(text).problem);
    CHECK(std::string(parse_integer(text).problem) == "is not an integer");
  }
}

TEST_CASE("the locale does not matter") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (!std::setlocale(LC_ALL, locale)) continue;
    check_round_trip(0.1);
    CHECK(text_of(0.5) == "0.5");
    CHECK(parse_real("1.5").value == 1.5);
  }
  std::setlocale(LC_ALL, before.c_str());
}
