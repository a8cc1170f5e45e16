// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <splinertia/allan/expected_accuracy.hpp>
#include <splinertia/allan/identify.hpp>

#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

TEST_CASE("Intervals hold the truth as often as they say") {
  constexpr int logs = 200;
  const double truth[] = {0.02, 0.03};
  int one_sigma[2] = {}, two_sigma[2] = {};
  double sums[2] = {}, squares[2] = {}, errors[2] = {};
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const auto y = simulated({.n = 4000, .rate = 50, .white = truth[0], .walk = truth[1], .seed = seed});
    const auto estimates = identify(y, 50, {.candidates = {NoiseTerm::white, NoiseTerm::random_walk}});
    for (int j = 0; j < 2; ++j) {
      const auto& estimate = estimates[noise_terms[static_cast<std::size_t>(j)]];
      CHECK(estimate.detected);
      const auto within = [&](const Interval<double>& interval) {
        return interval.lower <= truth[j] && truth[j] <= interval.upper ? 1 : 0;
      };
      one_sigma[j] += within(estimate.one_sigma);
      two_sigma[j] += within(estimate.interval);
      const double off = estimate.value / truth[j] - 1;
      sums[j] += off / logs;
      squares[j] += off * off / logs;
      errors[j] += estimate.standard_error() / truth[j] / logs;
    }
  }
  const auto expected = expected_accuracy(50.0, 80, truth[0], truth[1]);
  for (int j = 0; j < 2; ++j) {
    // Five standard deviations of binomial numbers: 6.6 and 3.1.
    INFO((j == 0 ? "N" : "K"));
    CHECK(std::abs(one_sigma[j] - 136.5) < 33);
    CHECK(two_sigma[j] >= 175);
    const double least = j == 0 ? expected.N : expected.K;
    CHECK(std::abs(sums[j]) < 5 * least / std::sqrt(static_cast<double>(logs)));
    // Five standard errors of a standard deviation: 1/√(2·200) each.
    CHECK_THAT(std::sqrt(squares[j]), WithinRel(least, 0.25));
    CHECK_THAT(errors[j], WithinRel(least, 0.1));
  }
}

TEST_CASE("A walk that is not there is seldom detected, and its limit is seldom too low") {
  constexpr int logs = 60;
  int detected = 0, above = 0;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const SimulatedNoise none{.n = 600, .rate = 50, .white = 0.02, .seed = seed};
    SimulatedNoise some = none;
    some.walk = 0.01;
    const IdentifyOptions<double> options{.candidates = {NoiseTerm::white, NoiseTerm::random_walk}};
    detected += identify(simulated(none), 50, options).K.detected ? 1 : 0;
    above += identify(simulated(some), 50, options).K.interval.upper > 0.01 ? 1 : 0;
  }
  CHECK(detected <= 5);
  CHECK(above >= 52);
}
