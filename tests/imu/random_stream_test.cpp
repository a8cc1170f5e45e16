// SPDX-License-Identifier: MIT
#include <random>
#include <set>
#include <splinertia/imu/random_stream.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("The generator is one of the standard library's kind") {
  STATIC_CHECK(std::uniform_random_bit_generator<Xoshiro256>);
}

TEST_CASE("Names give keys that do not collide") {
  std::set<std::uint64_t> keys;
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const char* sensor : {"gyro", "accel", "", "a", "aa"}) {
      for (std::uint64_t axis = 0; axis < 20; ++axis, ++count) keys.insert((StreamKey(seed) / sensor / axis).hash());
    }
  }
  CHECK(keys.size() == count);
  CHECK((StreamKey(1) / 2 / 3).hash() != (StreamKey(1) / 3 / 2).hash());
}

TEST_CASE("The generator is the published one") {
  // The state that key / 0 … key / 3 make, advanced by the recurrence written out by hand.
  const StreamKey key(7);
  std::uint64_t s[4];
  for (std::uint64_t i = 0; i < 4; ++i) s[i] = (key / i).hash();
  Xoshiro256 generator(key);
  const auto rotl = [](std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); };
  for (int n = 0; n < 1000; ++n) {
    const std::uint64_t expected = rotl(s[0] + s[3], 23) + s[0];
    const std::uint64_t t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotl(s[3], 45);
    REQUIRE(generator() == expected);
  }
}
