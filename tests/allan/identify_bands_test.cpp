// SPDX-License-Identifier: MIT
/// What identify() leaves out of a spectrum, by itself and when asked to.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <splinertia/allan/identify.hpp>
#include <string>
#include <vector>

#include "allan/disturbances.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia::allan;
using namespace splinertia::testing;

namespace {

using Values = std::vector<double>;
using Options = IdentifyOptions<double>;
constexpr std::size_t size = 60'000;  // 10 minutes at 100 Hz
constexpr double rate = 100, density = 1e-3, deviation = 0.01;

Values log_with(std::uint64_t seed, double walk = 0, double quantization = 0) {
  return simulated(
      {.n = size, .rate = rate, .white = density, .walk = walk, .quantization = quantization, .seed = seed});
}

bool names(const BandFit<double>& band, double frequency) {
  return band.frequencies.lower <= frequency * 1.01 && frequency * 0.99 <= band.frequencies.upper;
}

}  // namespace

TEST_CASE("A resonance of half a deviation is left out where it is") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    INFO("seed " << seed);
    Values y = log_with(seed);
    add_resonance(y, rate, 0.6, 10, deviation / 2, seed);
    const auto estimates = identify(y, rate);
    CHECK(estimates.fits);
    CHECK_THAT(estimates.N.value, WithinRel(density, 0.015));  // five standard errors: 1/√(2·60000) each
    CHECK(estimates.highest_frequency == rate / 2);
    REQUIRE_FALSE(estimates.excluded.empty());
    bool named = false;
    for (const auto& band : estimates.excluded) {
      named = named || names(band, 0.6);
      CHECK(band.frequencies.lower > 0.05);
      CHECK(band.frequencies.upper < 3);
    }
    CHECK(named);
    for (const NoiseTerm term : noise_terms) {
      if (term != NoiseTerm::white) CHECK_FALSE(estimates[term].detected);
    }
    // No more than all of a sample's noise could be.
    CHECK(estimates.Q.interval.upper < deviation / rate / std::sqrt(3));
  }
}

TEST_CASE("A line is left out, and what is beside it stays") {
  for (const double frequency : {0.05, 0.6, 7.0, 40.0}) {
    for (const std::uint64_t seed : {1U, 2U}) {
      INFO(frequency << " Hz, seed " << seed);
      Values y = log_with(seed, 1e-3);
      add_line(y, rate, deviation, frequency);
      const auto estimates = identify(y, rate);
      CHECK(estimates.fits);
      REQUIRE(estimates.excluded.size() == 1);
      CHECK(names(estimates.excluded[0], frequency));
      // Half its frequency on either side, and fifteen coefficients.
      const auto& band = estimates.excluded[0].frequencies;
      CHECK(band.upper - band.lower < frequency * 1.2 + 15 * rate / (2 * size));
      CHECK(estimates.excluded[0].ratio > 1.5);
      CHECK(estimates.highest_frequency == rate / 2);
      CHECK_THAT(estimates.N.value, WithinRel(density, 0.015));
      CHECK_THAT(estimates.K.value, WithinAbs(1e-3, 5 * estimates.K.standard_error()));
      CHECK_FALSE(estimates.Q.detected);
    }
  }
}

TEST_CASE("A strong line is left out, not the good octaves above it") {
  for (const double frequency : {0.6, 3.0, 20.0, 40.0}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      INFO(frequency << " Hz, seed " << seed);
      Values y = log_with(seed);
      add_line(y, rate, 4 * deviation, frequency);
      const auto estimates = identify(y, rate);
      CHECK(estimates.highest_frequency == rate / 2);
      REQUIRE_FALSE(estimates.excluded.empty());
      for (const auto& band : estimates.excluded) CHECK(band.frequencies.upper < 1.8 * frequency);
      CHECK_THAT(estimates.N.value, WithinRel(density, 0.015));
      for (const NoiseTerm term : noise_terms) {
        if (term != NoiseTerm::white) CHECK_FALSE(estimates[term].detected);
      }
    }
  }
}

TEST_CASE("Several lines have several bands, from the lowest up") {
  Values y = log_with(1);
  for (const double frequency : {25.0, 0.8, 5.0}) add_line(y, rate, deviation, frequency);
  const auto estimates = identify(y, rate);
  CHECK(estimates.fits);
  REQUIRE(estimates.excluded.size() == 3);
  CHECK(names(estimates.excluded[0], 0.8));
  CHECK(names(estimates.excluded[1], 5));
  CHECK(names(estimates.excluded[2], 25));
  CHECK_THAT(estimates.N.value, WithinRel(density, 0.015));
}

TEST_CASE("Too little power is left out as too much is") {
  for (const double factor : {0.3, 3.0}) {
    Values y = log_with(2);
    scale_power(y, rate, 2, 3, factor);
    const auto estimates = identify(y, rate);
    INFO(factor << " times the power");
    CHECK(estimates.fits);
    REQUIRE(estimates.excluded.size() == 1);
    CHECK_THAT(estimates.excluded[0].frequencies.lower, WithinAbs(2, 0.4));
    CHECK_THAT(estimates.excluded[0].frequencies.upper, WithinAbs(3, 0.5));
    CHECK((estimates.excluded[0].ratio > 1) == (factor > 1));
    CHECK_THAT(estimates.N.value, WithinRel(density, 0.015));
    const auto all = identify(y, rate, {.exclude_misfits = false});
    CHECK_FALSE(all.fits);
    CHECK(all.excluded.empty());
  }
}

TEST_CASE("Bands can be left out by hand") {
  Values y = log_with(3, 1e-3);
  add_line(y, rate, deviation, 7);
  const auto estimates = identify(y, rate, {.excluded = {{6.5, 7.5}, {20, 30}}, .exclude_misfits = false});
  CHECK(estimates.fits);
  REQUIRE(estimates.excluded.size() == 2);
  CHECK_THAT(estimates.excluded[0].frequencies.lower, WithinAbs(6.5, 0.2));
  CHECK_THAT(estimates.excluded[0].frequencies.upper, WithinAbs(7.5, 0.2));
  CHECK_THAT(estimates.excluded[1].frequencies.lower, WithinAbs(20, 0.5));
  CHECK_THAT(estimates.excluded[1].frequencies.upper, WithinAbs(30, 0.5));
  CHECK(estimates.excluded[0].ratio > 3);
  CHECK_THAT(estimates.excluded[1].ratio, WithinAbs(1, 0.1));
  CHECK_THAT(estimates.N.value, WithinRel(density, 0.015));
  CHECK(estimates.K.detected);
  for (const auto& point : estimates.spectrum) {
    const bool out = (point.frequency > 6.8 && point.frequency < 7.2) || (point.frequency > 21 && point.frequency < 29);
    const bool in = point.frequency < 6 || (point.frequency > 8 && point.frequency < 19) || point.frequency > 31;
    if (out) CHECK_FALSE(point.used);
    if (in) CHECK(point.used);
  }
  // Of white noise, the data that are left out cost their share of its accuracy.
  const auto whole = identify(log_with(3), rate, {.candidates = {NoiseTerm::white}});
  const auto part = identify(log_with(3), rate, {.candidates = {NoiseTerm::white}, .excluded = {{0, 12.5}}});
  CHECK_THAT(part.N.standard_error(), WithinRel(whole.N.standard_error() * std::sqrt(4.0 / 3), 0.03));
}

TEST_CASE("Without the upper end quantization noise is not identified") {
  const Values y = log_with(4, 1e-3, 1e-4);
  const auto whole = identify(y, rate);
  CHECK(whole.Q.detected);
  CHECK_THAT(whole.Q.value, WithinAbs(1e-4, 5 * whole.Q.standard_error()));
  const auto check_none = [](const NoiseEstimates<double>& estimates) {
    CHECK_FALSE(estimates.Q.detected);
    CHECK_FALSE(estimates.Q.possible);
    for (const auto& description : estimates.descriptions) CHECK_FALSE(description.terms.has(NoiseTerm::quantization));
  };
  check_none(identify(y, rate, {.highest_frequency = 30}));
  check_none(identify(y, rate, {.excluded = {{45, 60}}}));
  Values filtered = log_with(4, 1e-3);
  low_pass(filtered, 0.4);
  const auto estimates = identify(filtered, rate);
  CHECK(estimates.highest_frequency < rate / 2);
  check_none(estimates);
}

TEST_CASE("Bands that cannot be are refused") {
  const Values y = log_with(5);
  const auto refusal = [&](const Options& options) { return message_of([&] { return identify(y, rate, options); }); };
  CHECK(refusal({.excluded = {{3, 2}}}) ==
        "identify: upper end of an excluded band is 2, expected more than its lower end");
  CHECK(refusal({.excluded = {{1, 2}, {3, 3}}}) ==
        "identify: upper end of an excluded band is 3, expected more than its lower end");
  CHECK(refusal({.excluded = {{-1, 2}}}) == "identify: excluded band is -1, expected a finite number >= 0");
  CHECK(refusal({.excluded = {{1, std::numeric_limits<double>::quiet_NaN()}}}) ==
        "identify: upper end of an excluded band is nan, expected more than its lower end");
  CHECK(refusal({.excluded = {{0.01, 50}}}).starts_with("identify: the excluded bands leave "));
  CHECK(refusal({.excluded = {{0.01, 50}}}).ends_with(" bins of the spectrum, expected at least 64"));
  CHECK(refusal({.excluded = {{0, 1}, {0.5, 60}}}).starts_with("identify: the excluded bands leave 0 of "));
  CHECK(refusal({.excluded = {{1, 2}}}) == "nothing thrown");
}
