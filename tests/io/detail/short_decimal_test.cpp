// SPDX-License-Identifier: MIT
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <random>
#include <splinertia/io/detail/short_decimal.hpp>
#include <string>
#include <version>

#include "support/catch.hpp"

#if defined(__SIZEOF_INT128__)

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// What was read, with its end; the end is npos if it is left to std::from_chars.
struct Read {
  double value;
  std::size_t length;
};

Read read(const std::string& text) {
  Read result{0, std::string::npos};
  if (const char* const end = detail::short_decimal(text.data(), text.data() + text.size(), result.value)) {
    result.length = static_cast<std::size_t>(end - text.data());
  }
  return result;
}

bool is_left_to_others(const std::string& text) { return read(text).length == std::string::npos; }

}  // namespace

TEST_CASE("numbers end where they end") {
  CHECK(read("1.5").value == 1.5);
  CHECK(read("1.5,2").length == 3);
  CHECK(read("-12.25e1 7").value == -122.5);
  CHECK(read("-12.25e1 7").length == 8);
  CHECK(read("5.").length == 2);
  CHECK(read(".5").value == 0.5);
  CHECK(read("0.00000000000000000000001").value == 1e-23);  // zeros in front are no digits
  CHECK(std::signbit(read("-0.0").value));
}

TEST_CASE("what is long, far or no number is left to std::from_chars") {
  for (const char* text : {"", "-", ".", "-.", "x", "nan", "+1", "1e", "1e+", "1e1000", "1e28", "1e-28",
                           "12345678901234567890", "0.012345678901234567890123"}) {
    CAPTURE(text);
    CHECK(is_left_to_others(text));
  }
}

TEST_CASE("ties go to even, and what is just beside them does not") {
  // 2^53 + 1 lies in the middle of two doubles.
  CHECK(read("9007199254740993").value == 9007199254740992.0);
  CHECK(read("9007199254740993.001").value == 9007199254740994.0);
  CHECK(read("9007199254740992.999").value == 9007199254740992.0);
  CHECK(read("9007199254740995").value == 9007199254740996.0);
  CHECK(read("4503599627370496.5").value == 4503599627370496.0);
  CHECK(read("4503599627370497.5").value == 4503599627370498.0);
  CHECK(read("18446744073709551615").length == std::string::npos);
  CHECK(read("9999999999999999999").value == 1e19);
}

#if defined(__cpp_lib_to_chars)
TEST_CASE("the same bits as std::from_chars") {
  std::mt19937_64 random(1);
  int read_here = 0;
  const auto check = [&](const std::string& text) {
    const Read ours = read(text);
    if (ours.length == std::string::npos) return;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    CAPTURE(text);
    REQUIRE(error == std::errc{});
    REQUIRE(ours.length == static_cast<std::size_t>(end - text.data()));
    REQUIRE(std::bit_cast<std::uint64_t>(ours.value) == std::bit_cast<std::uint64_t>(value));
    ++read_here;
  };
  const auto digits = [&](std::uint64_t most) {
    std::string text;
    for (std::uint64_t count = random() % (most + 1); count > 0; --count)
      text += static_cast<char>('0' + random() % 10);
    return text;
  };
  for (int i = 0; i < 100'000; ++i) {
    std::string text = random() % 2 == 0 ? "-" : "";
    text += std::string(random() % 4, '0') + digits(12);
    if (random() % 4 > 0) text += "." + std::string(random() % 6, '0') + digits(18);
    if (random() % 3 == 0) text += (random() % 2 == 0 ? "e-" : "E") + digits(2);
    check(text);
    char shortest[32];
    const double value = static_cast<double>(static_cast<std::int64_t>(random())) * 1e-21;
    check(std::string(shortest, std::to_chars(shortest, shortest + sizeof shortest, value).ptr));
    std::snprintf(shortest, sizeof shortest, "%.18e", value);  // as numpy.savetxt
    check(shortest);
  }
  CHECK(read_here > 150'000);
}
#endif

#endif
