// SPDX-License-Identifier: MIT
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <splinertia/io/detail/little_endian.hpp>
#include <string_view>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEST_CASE("the lowest byte comes first") {
  std::array<char, 8> bytes{};
  CHECK(store_little_endian(bytes.data(), std::int64_t{0x0102030405060708}) == bytes.data() + 8);
  CHECK(std::string_view(bytes.data(), 8) == "\x08\x07\x06\x05\x04\x03\x02\x01");
  store_little_endian(bytes.data(), -1.0);
  CHECK(std::string_view(bytes.data(), 8) == std::string_view("\0\0\0\0\0\0\xF0\xBF", 8));
}

TEST_CASE("numbers come back with the same bits") {
  std::array<char, 8> bytes{};
  using Integers = std::numeric_limits<std::int64_t>;
  for (const std::int64_t value : {std::int64_t{0}, std::int64_t{-1}, Integers::min(), Integers::max()}) {
    store_little_endian(bytes.data(), value);
    CHECK(load_little_endian<std::int64_t>(bytes.data()) == value);
  }
  using Reals = std::numeric_limits<double>;
  for (const double value : {-0.0, 0.1, Reals::denorm_min(), Reals::lowest(), Reals::infinity(), Reals::quiet_NaN()}) {
    store_little_endian(bytes.data(), value);
    CHECK(std::bit_cast<std::uint64_t>(load_little_endian<double>(bytes.data())) ==
          std::bit_cast<std::uint64_t>(value));
  }
}
