// SPDX-License-Identifier: MIT
#include <random>
#include <set>
#include <splinertia/random/random_stream.hpp>
#include <string>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

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

TEST_CASE("Keys of a large run do not collide: 200 000 of 2^64") {
  // The chance that any two do is 1e-9.
  std::set<std::uint64_t> keys;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    for (std::uint64_t imu = 0; imu < 2; ++imu) {
      const StreamKey run = StreamKey(seed) / imu;
      for (std::uint64_t term = 0; term < 10; ++term)
        for (std::uint64_t axis = 0; axis < 10; ++axis) keys.insert((run / "gyro" / term / axis).hash());
    }
  }
  CHECK(keys.size() == 200'000);
}

TEST_CASE("A name is its characters and its length") {
  const StreamKey key(3);
  CHECK((key / std::string("gyro")).hash() == (key / "gyro").hash());
  CHECK((key / "a").hash() != (key / "b").hash());
  CHECK((key / std::string_view("a\0", 2)).hash() != (key / "a").hash());
  CHECK((key / "ab").hash() != (key / "a" / "b").hash());
  CHECK((key / "\xc3\xa9").hash() == 0x302b07249d558390U);  // not of the signedness of char
}

TEST_CASE("Keys and numbers are known while compiling") {
  constexpr std::uint64_t hash = (StreamKey(42) / "gyro" / 1).hash();
  constexpr std::uint64_t number = Xoshiro256(StreamKey(42))();
  CHECK(hash == (StreamKey(42) / "gyro" / 1).hash());
  CHECK(number == Xoshiro256(StreamKey(42))());
}

TEST_CASE("Scrambling is the published finaliser") {
  // SplitMix64 seeded with 1234567, whose first outputs are known: Rosetta Code, "Pseudo-random numbers/Splitmix64".
  std::uint64_t state = 1234567;
  for (const std::uint64_t expected : {6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                       4593380528125082431U, 16408922859458223821U}) {
    state += 0x9e3779b97f4a7c15U;
    CHECK(scramble(state) == expected);
  }
  CHECK(StreamKey(1234567).hash() == 6457827717110365317U);
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
