// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <splinertia/allan/record/freezes.hpp>
#include <splinertia/allan/record/steps.hpp>
#include <splinertia/random/normal.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "allan/simulated.hpp"
#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::allan;
using splinertia::testing::simulated;
using Values = std::vector<double>;

namespace {

constexpr std::size_t size = 120000;  // 20 minutes at 100 Hz

Values white(std::uint64_t seed = 0, std::size_t n = size) { return simulated({.n = n, .white = 1, .seed = seed}); }

void add_step(Values& signal, std::int64_t begin, double height, std::int64_t duration = 0) {
  for (std::int64_t i = begin; i < static_cast<std::int64_t>(signal.size()); ++i) {
    const double share = static_cast<double>(i - begin + 1) / static_cast<double>(duration + 1);
    signal[static_cast<std::size_t>(i)] += height * std::min(share, 1.0);
  }
}

/// A Gauss–Markov process of a deviation and correlation time in samples.
void add_gauss_markov(Values& signal, double deviation, double time, std::uint64_t seed) {
  NormalStream<> normal(StreamKey(seed) / 77);
  const double keep = std::exp(-1 / time), fresh = deviation * std::sqrt(1 - keep * keep);
  double state = deviation * normal();
  for (double& value : signal) {
    value += state;
    state = keep * state + fresh * normal();
  }
}

/// Adds a function of the time in s.
void add(Values& signal, const std::function<double(double)>& function) {
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] += function(static_cast<double>(i) / 100);
}

}  // namespace

TEST_CASE("noise of all kinds, drifts and vibration are no steps") {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const auto none = [&](const std::string& kind, const Values& signal) {
      INFO(kind << ' ' << seed);
      CHECK(find_steps(signal).empty());
    };
    none("white", white(seed));
    for (const double walk : {1e-3, 1e-2, 1.0}) {
      none("walk", simulated({.n = size, .white = 1, .walk = walk, .seed = seed}));
    }
    none("flicker", simulated({.n = size, .white = 1, .flicker = 0.1, .seed = seed}));
    none("quantization", simulated({.n = size, .white = 0.1, .quantization = 1, .seed = seed}));
    for (const double time : {10.0, 100.0, 600.0}) {
      Values signal = white(seed);
      add_gauss_markov(signal, std::sqrt(30 / (200 * time)), 100 * time, seed);
      none("Gauss–Markov", signal);
    }
    for (const double height : {1.0, 30.0}) {
      Values signal = white(seed);
      add(signal, [&](double t) { return height * t / 1200; });
      none("ramp", signal);
      signal = white(seed);
      add(signal, [&](double t) { return height * std::exp(-t / 600); });
      none("warming up", signal);
    }
    for (const double frequency : {0.05, 0.6, 40.0}) {
      Values signal = white(seed);
      add(signal, [&](double t) { return 2 * std::sin(2 * std::numbers::pi * frequency * t); });
      none("line", signal);
    }
    for (const double resolution : {0.3, 2.0, 4.0, 6.0}) {
      Values signal = white(seed);
      for (double& value : signal)
        value = resolution * std::round(value / resolution + 0.2 * static_cast<double>(seed));
      none("rounding", signal);
    }
    Values signal = white(seed);
    for (std::size_t i = 1; i < size; ++i) signal[i] = signal[i - 1] + 0.1 * (signal[i] - signal[i - 1]);
    none("low-pass", signal);
  }
}

TEST_CASE("noise that is stronger for a while and levels that are left at once are no steps") {
  for (std::uint64_t seed = 20; seed < 30; ++seed) {
    Values signal = white(seed);
    for (std::size_t i = 50000; i < 60000; ++i) signal[i] *= 2;
    for (std::size_t i = 100000; i < 100050; ++i) signal[i] += 5;
    for (std::size_t i = 110000; i < 110150; ++i) signal[i] -= 20;
    CHECK(find_steps(signal).empty());
  }
}

TEST_CASE("a step of half a sample's deviation or more is found, with its time and height") {
  for (const double height : {0.5, -1.0, 5.0, 500.0}) {
    for (const std::int64_t place : {20000, 64000, 91234}) {  // 64000 is the border of blocks of any usual length
      Values signal = white(4);
      add_step(signal, place, height);
      INFO(height << ' ' << place);
      const auto steps = find_steps(signal);
      REQUIRE(steps.size() == 1);
      CHECK(std::abs(steps[0].sample - place) <= std::llround(20 / (height * height)));
      CHECK_THAT(steps[0].height, WithinAbs(height, 3.5 * steps[0].standard_error));
      CHECK(steps[0].standard_error < 0.05);
      CHECK(steps[0].significance > 7);
      CHECK(steps[0].duration == 0);
    }
  }
}

TEST_CASE("steps near the ends are found") {
  struct Case {
    double height;
    std::int64_t distance;
  };
  for (const Case& some : {Case{0.5, 1200}, Case{1, 250}, Case{5, 20}}) {
    for (const std::int64_t place : {some.distance, static_cast<std::int64_t>(size) - some.distance}) {
      Values signal = white(1);
      add_step(signal, place, some.height);
      INFO(some.height << ' ' << place);
      const auto steps = find_steps(signal);
      REQUIRE(steps.size() == 1);
      CHECK(std::abs(steps[0].sample - place) <= std::llround(20 / (some.height * some.height)));
      CHECK_THAT(steps[0].height, WithinRel(some.height, 0.3));
    }
  }
}

TEST_CASE("several steps are told apart") {
  Values signal = white(2);
  const std::vector<std::pair<std::int64_t, double>> truth{
      {20000, 1}, {25000, 1}, {26000, 1.5}, {60000, -0.7}, {90000, 30}};
  for (const auto& [place, height] : truth) add_step(signal, place, height);
  const auto steps = find_steps(signal);
  REQUIRE(steps.size() == truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    CHECK(std::abs(steps[i].sample - truth[i].first) <= 30);
    CHECK_THAT(steps[i].height, WithinRel(truth[i].second, 0.15));
  }
}

TEST_CASE("a slow tilt is one step") {
  for (const auto& [height, duration] : {std::pair<double, std::int64_t>{25, 300}, {500, 1000}}) {
    Values signal = white(3);
    add_step(signal, 50000, height, duration);
    INFO(height);
    const auto steps = find_steps(signal);
    REQUIRE(steps.size() == 1);
    CHECK(std::abs(steps[0].sample - 50000 - duration) <= 8);
    CHECK(std::abs(steps[0].duration - duration) <= 16);
    CHECK_THAT(steps[0].height, WithinRel(height, 0.01));
  }
  Values signal = white(3);  // that begins and ends smoothly
  add(signal, [](double t) { return 500 * (1 - std::cos(std::numbers::pi * std::clamp(t / 6 - 80, 0.0, 1.0))) / 2; });
  const auto steps = find_steps(signal);
  REQUIRE(steps.size() == 1);
  CHECK_THAT(steps[0].height, WithinRel(500, 0.001));
}

TEST_CASE("a step is found beside a random walk, a drift and vibration") {
  Values walk = simulated({.n = size, .white = 1, .walk = 1e-3, .seed = 5});
  Values drift = white(6), vibration = white(7);
  add(drift, [](double t) { return 10 * std::exp(-t / 600); });
  add(vibration, [](double t) { return std::sin(2 * std::numbers::pi * 7 * t); });
  for (Values* signal : {&walk, &drift, &vibration}) {
    add_step(*signal, 70000, 1.5);
    const auto steps = find_steps(*signal);
    REQUIRE(steps.size() == 1);
    CHECK(std::abs(steps[0].sample - 70000) <= 20);
    CHECK_THAT(steps[0].height, WithinRel(1.5, 0.2));
  }
}

TEST_CASE("knocks are no steps, and hide none") {
  Values signal = white(8);
  for (std::size_t i = 1000; i < size; i += 9973) signal[i] += 1e5;
  for (std::size_t i = 0; i < 200; ++i) {
    const auto t = static_cast<double>(i);
    signal[30000 + i] += 100 * std::exp(-t / 50) * std::sin(0.7 * t);
  }
  CHECK(find_steps(signal).empty());
  add_step(signal, 60000, 0.7);
  const auto steps = find_steps(signal);
  REQUIRE(steps.size() == 1);
  CHECK(std::abs(steps[0].sample - 60000) <= 50);
}

TEST_CASE("spans can be left out") {
  Values signal = white(9);
  for (std::size_t i = 40000; i < 70000; ++i) signal[i] = 3;
  CHECK(find_steps(signal).size() == 2);
  CHECK(find_steps(signal, {.left_out = find_freezes(signal)}).empty());
}

TEST_CASE("the smallest height of interest") {
  Values signal = white(10);
  add_step(signal, 50000, 1);
  CHECK(find_steps(signal, {.least_height = 0.8}).size() == 1);
  CHECK(find_steps(signal, {.least_height = 1.2}).empty());
  Values quiet(size, 5.0);  // nothing to compare with, but a height
  add_step(quiet, 50000, 1);
  CHECK(find_steps(quiet).empty());
  const auto steps = find_steps(quiet, {.least_height = 0.5});
  REQUIRE(steps.size() == 1);
  CHECK(steps[0].sample == 50000);
  CHECK_THAT(steps[0].height, WithinRel(1, 1e-9));
}

TEST_CASE("heights are in the unit of the signal, whatever its mean and type") {
  Values signal = white(11);
  add_step(signal, 50000, 2);
  const auto of_doubles = find_steps(signal);
  std::vector<long double> extended;
  for (const double value : signal) extended.push_back(1e-3L * static_cast<long double>(value) + 1000);
  const auto of_extended = find_steps(extended);
  REQUIRE(of_doubles.size() == 1);
  REQUIRE(of_extended.size() == 1);
  CHECK(of_extended[0].sample == of_doubles[0].sample);
  CHECK_THAT(of_extended[0].height, WithinRel(1e-3 * of_doubles[0].height, 1e-6));
}

TEST_CASE("short signals have no steps, bad options are refused") {
  using splinertia::test::error_of;
  CHECK(find_steps(Values{1, 2, 3}).empty());
  Values signal = white(12, 1000);
  add_step(signal, 500, 100);
  CHECK(find_steps(signal).empty());
  CHECK(error_of<std::invalid_argument>([&] { (void)find_steps(signal, {.false_alarms = 0}); }) ==
        "find_steps: false_alarms is 0, expected a probability in (0, 1)");
  CHECK(error_of<std::invalid_argument>([&] { (void)find_steps(signal, {.least_height = -1}); }) ==
        "find_steps: least_height is -1, expected a finite number >= 0");
}
