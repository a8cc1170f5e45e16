// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/output/stuck_readings.hpp>
#include <vector>

#include "errors/one_term.hpp"
#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

namespace {

// The lengths of the runs of repeated samples, of `n` samples that all differ without the term.
std::vector<int> runs(double probability, double length, std::size_t n, int& fresh) {
  const ErrorModel model{RateRamp{1}, StuckReadings{probability, length}};
  const Record errors = record<double>(model, regular(1, n), 2);
  CHECK(errors.all_bias);
  CHECK(errors.axes[0] == errors.axes[2]);
  std::vector<int> lengths;
  fresh = 0;
  bool stuck = false;
  for (std::size_t i = 0; i < n; ++i) {
    const bool repeats = errors.axes[0][i] != static_cast<double>(i);
    if (repeats) {
      REQUIRE(errors.axes[0][i] == errors.axes[0][i - 1]);
      if (!stuck) lengths.push_back(0);
      ++lengths.back();
    } else {
      ++fresh;
    }
    stuck = repeats;
  }
  return lengths;
}

}  // namespace

TEST_CASE("Runs of repeated samples begin and last as asked for") {
  for (const double length : {1.0, 2.0, 10.0}) {
    const double p = 0.05;
    int fresh = 0;
    const auto lengths = runs(p, length, 200'000, fresh);
    const auto n = static_cast<double>(lengths.size());
    CHECK(std::abs(n - p * fresh) < 4 * std::sqrt(p * (1 - p) * fresh));
    double sum = 0, ones = 0;
    for (const int l : lengths) {
      sum += l;
      ones += l == 1;
    }
    // Geometric: variance L(L − 1), a share 1/L of length 1.
    CHECK(std::abs(sum / n - length) <= 4 * std::sqrt(length * (length - 1) / n));
    CHECK(std::abs(ones / n - 1 / length) <= 4 * std::sqrt(1 / length * (1 - 1 / length) / n));
    const double stuck = p * length / (1 + p * length);
    CHECK(std::abs(1 - fresh / 2e5 - stuck) < 4 * std::sqrt(2 * length * stuck / 2e5));
  }
}

TEST_CASE("With probability one every other sample repeats, with zero none") {
  int fresh = 0;
  CHECK(runs(1, 1, 1000, fresh) == std::vector<int>(500, 1));
  CHECK(runs(0, 5, 1000, fresh).empty());
  CHECK(fresh == 1000);
}

TEST_CASE("Stuck readings are described and checked") {
  CHECK(describe(StuckReadings{0.01, 20}, "m") == "stuck readings: probability 0.01, mean length 20 samples");
  CHECK_THROWS_WITH((StuckReadings{0.1, 0.5}), "StuckReadings: mean length is 0.5, expected a finite number >= 1");
  CHECK_THROWS_AS((StuckReadings{-0.1}), std::invalid_argument);
}
