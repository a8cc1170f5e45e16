// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>
#include <splinertia/allan/record/bursts.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia::allan;

namespace {

/// The intervals of bursts of so many samples, `spacing` apart, at 200 Hz on average, with shares of jitter of both.
std::vector<double> bursts_of(int samples, double spacing, double jitter = 0, int bursts = 300) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> intervals;
  for (int i = 0; i < bursts; ++i) {
    double pause = 0.005 * samples * (1 + jitter / 2 * uniform(random));
    for (int k = 1; k < samples; ++k) {
      intervals.push_back(spacing * (1 + jitter * uniform(random)));
      pause -= intervals.back();
    }
    intervals.push_back(pause);
  }
  return intervals;
}

}  // namespace

TEST_CASE("bursts of 2 to 100 samples are recognised") {
  for (const int samples : {2, 3, 4, 10, 32, 100}) {
    for (const double jitter : {0.0, 0.5}) {
      CAPTURE(samples, jitter);
      const auto bursts = find_bursts(bursts_of(samples, 60e-6, jitter));
      REQUIRE(bursts);
      CHECK_THAT(bursts->samples, WithinRel(samples, 1e-12));
      CHECK_THAT(bursts->spacing, WithinRel(60e-6, 0.1));
      CHECK_THAT(bursts->period, WithinRel(0.005 * samples, 0.03));
      CHECK_THAT(bursts->rate, WithinRel(200.0, 0.03));
      CHECK(bursts->holes == 0);
      CHECK(bursts->missing == 0);
    }
  }
}

TEST_CASE("a part of a burst at either end does not change the rate") {
  auto intervals = bursts_of(10, 60e-6);
  intervals.erase(intervals.begin(), intervals.begin() + 7);
  intervals.resize(intervals.size() - 4);
  CHECK_THAT(find_bursts(intervals)->rate, WithinRel(200.0, 1e-9));
}

TEST_CASE("a hole between bursts is missing samples, not time between them") {
  auto intervals = bursts_of(4, 60e-6);
  intervals[403] += 2;
  const auto bursts = find_bursts(intervals);
  REQUIRE(bursts);
  CHECK_THAT(bursts->rate, WithinRel(200.0, 1e-3));
  CHECK(bursts->holes == 1);
  CHECK(bursts->missing == 400);
}

TEST_CASE("other intervals are no bursts") {
  CHECK_FALSE(find_bursts({}));
  CHECK_FALSE(find_bursts(std::vector<double>(1000, 0.005)));
  CHECK_FALSE(find_bursts(bursts_of(2, 0.0015)));  // late stamps, rather
  CHECK_FALSE(find_bursts(bursts_of(200, 60e-6)));
  CHECK_FALSE(find_bursts(bursts_of(2, 60e-6, 0, 7)));
  std::vector<double> jitter, waiting, one_gap(1000, 0.005);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> exponential;
  for (int i = 0; i < 1000; ++i) jitter.push_back(0.005 * std::abs(1 + 0.4 * normal(random)));
  for (int i = 0; i < 1000; ++i) waiting.push_back(0.005 * exponential(random));
  one_gap[500] = 3600;
  CHECK_FALSE(find_bursts(jitter));
  CHECK_FALSE(find_bursts(waiting));
  CHECK_FALSE(find_bursts(one_gap));
}
