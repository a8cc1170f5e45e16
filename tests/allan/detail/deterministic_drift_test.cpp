// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <span>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/allan/detail/deterministic_drift.hpp>
#include <vector>

#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

constexpr std::size_t size = 60'000;
constexpr double rate = 100, deviation = 0.01;

std::vector<double> white(std::uint64_t seed) {
  return simulated({.n = size, .rate = rate, .white = deviation / std::sqrt(rate), .seed = seed});
}

double time_of(std::size_t i) { return static_cast<double>(i) / rate; }

/// The best drift in white noise of known size.
DeterministicDrift<double> drift_of(const std::vector<double>& y) {
  const DifferenceSpectrum<double> spectrum(IntegratedSignal<double>(y, rate));
  const PooledSpectrum<double> pooled(std::span(&spectrum, 1));
  const double unit = pooled.unit();
  std::vector<double> expected;
  for (const auto& bin : pooled.bins()) expected.push_back(bin.basis[0] * deviation * deviation / (unit * unit));
  return best_drift(pooled, std::vector<bool>(pooled.bins().size(), true), expected);
}

}  // namespace

TEST_CASE("White noise has no drift to speak of") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) CHECK(drift_of(white(seed)).gain < 9);
}

TEST_CASE("The gain of a step is its square over its variance") {
  for (const double index_of : {0.2, 0.5, 0.83}) {
    auto y = white(7);
    for (std::size_t i = 0; i < size; ++i) y[i] += time_of(i) < index_of * 600 ? 0 : deviation / 2;
    const auto drift = drift_of(y);
    INFO("at " << index_of);
    REQUIRE(drift.steps.size() == 1);
    CHECK_THAT(drift.steps[0], WithinAbs(index_of * 600, 3));
    // (δ/σ)²·n·p(1 − p), less 9 for its price.
    CHECK_THAT(drift.gain, WithinRel(size * index_of * (1 - index_of) / 4, 0.1));
  }
}

TEST_CASE("Several steps are found one by one") {
  auto y = white(8);
  for (std::size_t i = 0; i < size; ++i) y[i] += (time_of(i) > 200 ? 0.005 : 0) - (time_of(i) > 420 ? 0.005 : 0);
  const auto drift = drift_of(y);
  // Their times are looked for in four hundred places: a third one mends where these are.
  REQUIRE(drift.steps.size() >= 2);
  CHECK(drift.steps.size() <= 3);
  CHECK_THAT(drift.steps.front(), WithinAbs(200, 5));
  CHECK_THAT(drift.steps.back(), WithinAbs(420, 5));
}

TEST_CASE("A smooth drift is no step") {
  auto y = white(9);
  for (std::size_t i = 0; i < size; ++i) y[i] += 0.01 * std::sin(2 * std::numbers::pi * time_of(i) / 1500);
  const auto drift = drift_of(y);
  CHECK(drift.steps.empty());
  CHECK(drift.gain > 1000);
}

TEST_CASE("Slow noise that a mean describes as well is not detected") {
  auto steps = white(10), smooth = white(11);
  for (std::size_t i = 0; i < size; ++i) {
    steps[i] += (time_of(i) > 200 ? 0.004 : 0) - (time_of(i) > 420 ? 0.004 : 0);
    smooth[i] += 0.01 * std::sin(2 * std::numbers::pi * time_of(i) / 1500);
  }
  for (const auto& y : {steps, smooth}) {
    const auto noise = analyse(y, rate).noise;
    CHECK(noise.may_be_drift);
    CHECK_FALSE(noise.K.detected);
    CHECK_FALSE(noise.B.detected);
    CHECK_FALSE(noise.G.detected);
  }
  CHECK(identify(steps, rate).step_times.size() >= 2);
  // A walk of many periods is none of these, and who names no drift among the candidates is believed.
  const auto walk = simulated({.n = size, .rate = rate, .white = 1e-3, .walk = 1e-3, .seed = 12});
  CHECK_FALSE(identify(walk, rate).may_be_drift);
  CHECK(identify(walk, rate).K.detected);
  CHECK(identify(steps, rate, {.candidates = {NoiseTerm::white, NoiseTerm::random_walk}}).K.detected);
}
