// SPDX-License-Identifier: MIT
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/random/detail/random_bits.hpp>
#include <vector>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace splinertia::testing;

namespace {

// Counts from Lowest to Highest, and again, whatever its key.
template <typename Result, Result Lowest, Result Highest>
struct Counter {
  using result_type = Result;
  Result next = Lowest;
  constexpr explicit Counter(StreamKey) {}
  static constexpr Result min() { return Lowest; }
  static constexpr Result max() { return Highest; }
  constexpr Result operator()() {
    const Result result = next;
    next = next == Highest ? Lowest : static_cast<Result>(next + 1);
    return result;
  }
};

// A user's generator that takes keys.
struct Keyed {
  std::uint64_t seed;
  explicit Keyed(StreamKey key) : seed(key.hash() + 1) {}
  static constexpr std::uint64_t min() { return 0; }
  static constexpr std::uint64_t max() { return ~std::uint64_t{0}; }
  std::uint64_t operator()() { return seed; }
};

using Bits11 = std::independent_bits_engine<std::mt19937, 11, std::uint32_t>;
using Shuffled = std::knuth_b;

}  // namespace

TEMPLATE_TEST_CASE("Any generator of the standard library will do", "", Xoshiro256, std::mt19937, std::mt19937_64,
                   std::minstd_rand0, std::minstd_rand, std::ranlux24_base, std::ranlux48_base, std::ranlux24,
                   std::ranlux48, Shuffled, Bits11) {
  STATIC_CHECK(BitGenerator<TestType>);
  // Each of the 64 bits is one in half of the draws, and independent of the one before it and of its neighbour.
  constexpr int n = 50'000;
  RandomBits<TestType> bits(StreamKey(24));
  std::array<int, 64> ones{}, changes{}, differs{};
  std::uint64_t previous = bits();
  for (int i = 0; i < n; ++i) {
    const std::uint64_t x = bits();
    for (std::size_t k = 0; k < 64; ++k) {
      ones[k] += static_cast<int>(x >> k & 1);
      changes[k] += static_cast<int>((x ^ previous) >> k & 1);
      differs[k] += static_cast<int>((x ^ std::rotl(x, 1)) >> k & 1);
    }
    previous = x;
  }
  // Of one count, the square of how far it is off in standard errors has mean 1 and variance 2; of 64, their sum.
  const auto squares = [](const std::array<int, 64>& counts) {
    double sum = 0;
    for (const int count : counts) sum += std::pow((count - n / 2.0) / std::sqrt(n / 4.0), 2);
    return Estimate{sum, 64, std::sqrt(128.0)};
  };
  CHECK(off(squares(ones)) < 4);
  CHECK(off(squares(changes)) < 4);
  CHECK(off(squares(differs)) < 4);
}

TEMPLATE_TEST_CASE("The key is the seed", "", Xoshiro256, std::mt19937, std::mt19937_64, std::minstd_rand,
                   std::ranlux24) {
  RandomBits<TestType> one(StreamKey(1)), same(StreamKey(1)), other(StreamKey(2));
  const std::uint64_t first = one();
  CHECK(first == same());
  CHECK(first != other());
  CHECK(one() != first);
}

TEST_CASE("A generator of 64 bits is used as it is, seeded with the hash of the key") {
  const StreamKey key = StreamKey(1) / "a";
  std::mt19937_64 expected(key.hash());
  RandomBits<std::mt19937_64> bits(key);
  for (int i = 0; i < 10; ++i) CHECK(bits() == expected());
  Xoshiro256 own(key);
  RandomBits own_bits(key);
  for (int i = 0; i < 10; ++i) CHECK(own_bits() == own());
  CHECK(RandomBits<Keyed>(key)() == key.hash() + 1);
}

TEST_CASE("Bits of small generators are put together, values beyond a power of two drawn again") {
  // 4 bits of 0 … 15, then the same of 0 … 19 and of 100 … 119, and of two values.
  CHECK(RandomBits<Counter<std::uint64_t, 0, 15>>(StreamKey(1))() == 0x0123456789abcdefU);
  RandomBits<Counter<std::uint64_t, 0, 19>> twenty(StreamKey(1));
  CHECK(twenty() == 0x0123456789abcdefU);
  CHECK(twenty() == 0x0123456789abcdefU);
  CHECK(RandomBits<Counter<std::uint8_t, 100, 119>>(StreamKey(1))() == 0x0123456789abcdefU);
  CHECK(RandomBits<Counter<std::uint16_t, 7, 8>>(StreamKey(1))() == 0x5555555555555555U);
  // 11 bits six times: the first two are pushed out, all but their last.
  CHECK(
      RandomBits<Counter<std::uint32_t, 0, 2047>>(StreamKey(1))() ==
      ((std::uint64_t{1} << 44) | (std::uint64_t{2} << 33) | (std::uint64_t{3} << 22) | (std::uint64_t{4} << 11) | 5));
  // All but one of 2⁶⁴ values: 63 bits at a time.
  constexpr std::uint64_t all = ~std::uint64_t{0};
  CHECK(RandomBits<Counter<std::uint64_t, 1, all>>(StreamKey(1))() == 1);
  CHECK(RandomBits<Counter<std::uint64_t, 0, all>>(StreamKey(1))() == 0);
}

TEST_CASE("Bits can be drawn while compiling") {
  constexpr std::uint64_t bits = [] { return RandomBits(StreamKey(5))(); }();
  CHECK(bits == RandomBits(StreamKey(5))());
}

TEST_CASE("Simulated with the Mersenne twister, errors have the same statistics and other numbers") {
  const Imu imu{ErrorModel{WhiteNoise{0.015}}, ErrorModel{RandomWalk{0.1}}};
  const auto motion = at_rest(SO3xR3<double>{});
  const auto run = simulate<std::mt19937_64>(motion, imu, {.rate = 200, .seed = 1, .start = 0.0, .end = 1000.0});
  std::vector<double> noise, moves;
  double before = 0;
  for (const auto& r : run) {
    noise.push_back(r.gyro.x() / (0.015 * std::sqrt(200.0)));
    if (noise.size() > 1) moves.push_back((r.accel_bias.y() - before) / (0.1 / std::sqrt(200.0)));
    before = r.accel_bias.y();
  }
  for (const std::size_t lag : {0U, 1U}) {
    CHECK(off(white_autocovariance(noise, lag)) < 4);
    CHECK(off(white_autocovariance(moves, lag)) < 4);
  }
  CHECK(off(mean_product(moves, std::vector<double>(noise.begin() + 1, noise.end()))) < 4);
  CHECK(run.begin()->gyro == run.begin()->gyro);
  CHECK(run.begin()->gyro != simulate(motion, imu, {.seed = 1, .start = 0.0, .end = 1000.0}).begin()->gyro);
}
