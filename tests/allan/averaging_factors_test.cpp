// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <splinertia/allan/averaging_factors.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using splinertia::allan::AveragingFactors;
using splinertia::testing::message_of;
using Factors = std::vector<std::int64_t>;

TEST_CASE("The usual grids of averaging factors") {
  CHECK(AveragingFactors::octave().up_to(1) == Factors{1});
  CHECK(AveragingFactors::octave().up_to(100) == Factors{1, 2, 4, 8, 16, 32, 64});
  CHECK(AveragingFactors::octave().up_to(128) == Factors{1, 2, 4, 8, 16, 32, 64, 128});
  CHECK(AveragingFactors::decade().up_to(450) == Factors{1, 2, 4, 10, 20, 40, 100, 200, 400});
  CHECK(AveragingFactors::all().up_to(5) == Factors{1, 2, 3, 4, 5});
  for (const auto& grid : {AveragingFactors::octave(), AveragingFactors::decade(), AveragingFactors::all(),
                           AveragingFactors::logarithmic()}) {
    CHECK(grid.up_to(0).empty());
  }
  const Factors octaves = AveragingFactors::octave().up_to(std::numeric_limits<std::int64_t>::max());
  CHECK(octaves.size() == 62);
  CHECK(octaves.back() == std::int64_t{1} << 61);
}

TEST_CASE("A logarithmic grid is even, ascending, and doubles") {
  for (int per_octave : {1, 2, 3, 5, 10, 64, 1000}) {
    INFO(per_octave << " per octave");
    const std::int64_t largest = 10'000'000;
    const Factors factors = AveragingFactors::logarithmic(per_octave).up_to(largest);
    REQUIRE(!factors.empty());
    CHECK(factors.front() == 1);
    CHECK(factors.back() <= largest);
    CHECK(std::adjacent_find(factors.begin(), factors.end(), std::greater_equal<>()) == factors.end());
    for (std::int64_t m = 1; m <= largest; m *= 2) CHECK(std::binary_search(factors.begin(), factors.end(), m));
    // From the first power of two that is at least four times the number per octave, and 16.
    std::int64_t doubling = 16;
    while (doubling < 4 * per_octave) doubling *= 2;
    for (const std::int64_t m : factors) {
      if (m < doubling || 2 * m > largest) continue;
      if (!std::binary_search(factors.begin(), factors.end(), 2 * m)) FAIL_CHECK(m << " without its double");
    }
    const auto first = std::lower_bound(factors.begin(), factors.end(), doubling);
    const auto next = std::lower_bound(factors.begin(), factors.end(), 2 * doubling);
    CHECK(next - first == per_octave);
    for (auto m = first; m != next; ++m) {
      const double ideal = static_cast<double>(doubling) * std::exp2(static_cast<double>(m - first) / per_octave);
      CHECK(std::abs(static_cast<double>(*m) - ideal) <= 0.5);
    }
  }
  CHECK(AveragingFactors::logarithmic().up_to(20) == Factors{1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 14, 16, 19});
}

TEST_CASE("Factors and averaging times that are given") {
  CHECK(AveragingFactors::given({7, 3, 3, 1}).up_to(10) == Factors{1, 3, 7});
  CHECK(AveragingFactors::given({}).up_to(10).empty());
  CHECK(AveragingFactors::taus({0.005, 0.0126, 1.0, 100.0}, 200.0).up_to(100000) == Factors{1, 3, 200, 20000});
  CHECK(AveragingFactors::taus({0.0025f}, 200.0f).up_to(10) == Factors{1});
  CHECK(AveragingFactors::taus({84.0L}, 1 / 42.0L).up_to(10) == Factors{2});
}

TEST_CASE("Factors that cannot be are refused") {
  CHECK(message_of([] { return AveragingFactors::given({1, 0}).up_to(10); }) ==
        "Allan analysis: averaging factor 0 is outside the data, expected 1 to 10");
  CHECK(message_of([] { return AveragingFactors::given({1, 11}).up_to(10); }) ==
        "Allan analysis: averaging factor 11 is outside the data, expected 1 to 10");
  CHECK(message_of([] { return AveragingFactors::given({-1}).up_to(10); }) ==
        "Allan analysis: averaging factor -1 is outside the data, expected 1 to 10");
  CHECK(message_of([] { return AveragingFactors::taus({1.0, 0.0024}, 200.0); }) ==
        "AveragingFactors::taus: tau is 0.0024, expected at least half a sampling interval");
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (double tau : {0.0, -1.0, nan, infinity, 1e300}) {
    INFO("tau " << tau);
    CHECK_THROWS_AS(AveragingFactors::taus({tau}, 200.0), std::invalid_argument);
  }
  CHECK(message_of([] { return AveragingFactors::taus({1.0}, 0.0); }) ==
        "AveragingFactors::taus: rate is 0, expected a finite number > 0");
  for (double rate : {-200.0, nan, infinity}) {
    CHECK_THROWS_AS(AveragingFactors::taus({1.0}, rate), std::invalid_argument);
  }
  CHECK(message_of([] { return AveragingFactors::logarithmic(0); }) ==
        "AveragingFactors::logarithmic: per_octave is 0, expected 1 to 1000");
  CHECK_THROWS_AS(AveragingFactors::logarithmic(1001), std::invalid_argument);
}
