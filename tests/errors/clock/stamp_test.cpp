// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/random/detail/random_bits.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

TEST_CASE("The next stamp in seconds is another nanosecond in a file, and hardly later") {
  RandomBits bits(StreamKey(1));
  for (const double size : {0.0, 1e-6, 1.0, 1e3, 1e6, 1.4e9, 9e9}) {
    for (int i = 0; i < 20'000; ++i) {
      const double t = size * (static_cast<double>(bits() >> 11) * 0x1p-52 - 1);
      const double next = next_stamp(t);
      REQUIRE(next > t);
      REQUIRE(to_nanoseconds(next) > to_nanoseconds(t));
      REQUIRE(next - t < 1.5e-9 + 6 * std::numeric_limits<double>::epsilon() * std::abs(t));
    }
  }
}

TEST_CASE("The next stamp of a small number is larger, too") {
  CHECK(next_stamp(1e6F) > 1e6F);
  CHECK(next_stamp(0.0F) > 0.0F);
  CHECK(next_stamp(1e300) > 1e300);
  CHECK(next_stamp(-1e300) > -1e300);
  CHECK(next_stamp(1e9L) > 1e9L);
}

TEST_CASE("The next stamp in ticks is a tick later") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  CHECK(next_stamp(epoch) == epoch + nanoseconds{1});
  CHECK(next_stamp(std::chrono::microseconds{-1}) == std::chrono::microseconds{0});
}
