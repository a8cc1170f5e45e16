// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <splinertia/allan/record/missing_samples.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using splinertia::test::error_of;

namespace {

/// The intervals between increasing times, all in s.
std::vector<double> intervals_of(const std::vector<double>& times) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  return intervals;
}

std::int64_t count(const std::vector<MissingSamples>& places) {
  std::int64_t sum = 0;
  for (const MissingSamples& place : places) sum += place.count;
  return sum;
}

/// Stamps at 1 Hz with normal jitter, of which `missing` are dropped at random, and not at the ends.
std::vector<double> jittered(std::mt19937_64& random, int samples, double jitter, int missing) {
  std::normal_distribution<double> normal;
  std::vector<int> places;
  for (int i = 50; i < samples - 50; ++i) places.push_back(i);
  std::shuffle(places.begin(), places.end(), random);
  places.resize(static_cast<std::size_t>(missing));
  std::vector<double> times;
  for (int i = 0; i < samples; ++i) {
    if (std::find(places.begin(), places.end(), i) != places.end()) continue;
    const double time = i + jitter * normal(random);
    times.push_back(times.empty() ? time : std::max(time, times.back() + 1e-6));
  }
  return times;
}

}  // namespace

TEST_CASE("jitter invents no missing samples and hides none") {
  std::mt19937_64 random(1);
  for (const double jitter : {0.0, 0.1, 0.2, 0.3}) {
    for (const int missing : {0, 1, 20}) {
      for (int seed = 0; seed < 10; ++seed) {
        CAPTURE(jitter, missing, seed);
        REQUIRE(count(find_missing_samples(intervals_of(jittered(random, 4000, jitter, missing)), 1.0)) == missing);
      }
    }
  }
}

TEST_CASE("places of gaps, and how many are missing in each") {
  std::vector<double> intervals(100, 1);
  intervals[20] = 2;
  intervals[60] = 5001.2;  // a sensor that was started anew is off the grid
  const auto places = find_missing_samples(intervals, 1);
  REQUIRE(places.size() == 2);
  CHECK(places[0].interval == 20);
  CHECK(places[0].count == 1);
  CHECK(places[1].interval == 60);
  CHECK(places[1].count == 5000);
}

TEST_CASE("samples that come late and catch up are not missing") {
  std::vector<double> times;
  for (int i = 0; i < 2000; ++i) times.push_back(i);
  times[300] += 0.9;                                                                        // one
  for (int i = 0; i < 8; ++i) times[700 + static_cast<std::size_t>(i)] = 707.9 + 0.01 * i;  // one after the other
  for (std::size_t i = 1200; i < 1260; ++i) times[i] += 4;                                  // all of a minute
  for (std::size_t i = 1260; i < 1264; ++i) times[i] = 1263.1 + 0.1 * static_cast<double>(i - 1260);
  CHECK(find_missing_samples(intervals_of(times), 1).empty());
}

TEST_CASE("the nominal interval may be off, and the clock may drift") {
  std::vector<double> times;
  for (int i = 0; i < 20000; ++i) times.push_back(1.002 * i + 8 * std::sin(i / 2000.0));
  times.erase(times.begin() + 9000);
  const auto places = find_missing_samples(intervals_of(times), 1);
  REQUIRE(places.size() == 1);
  CHECK(places[0].interval == 8999);
  CHECK(places[0].count == 1);
}

TEST_CASE("gaps longer than any log count as a billion samples") {
  std::vector<double> intervals(100, 1);
  intervals[20] = 1e300;
  const auto places = find_missing_samples(intervals, 1);
  REQUIRE(places.size() == 1);
  CHECK(places[0].count == 999'999'999);
}

TEST_CASE("few intervals, none, and a nominal interval that is none") {
  CHECK(find_missing_samples({}, 1).empty());
  CHECK(find_missing_samples({1}, 1).empty());
  CHECK(error_of<std::invalid_argument>([] { (void)find_missing_samples({1}, 0); }) ==
        "find_missing_samples: nominal is 0, expected a finite number > 0");
}
