// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <splinertia/allan/detail/band_selection.hpp>
#include <utility>
#include <vector>

#include "allan/disturbances.hpp"
#include "allan/log_fit.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Selection = BandSelection<double>;
using Gaps = std::vector<std::pair<std::size_t, std::size_t>>;
constexpr std::size_t size = 20'000;
constexpr double rate = 50;
constexpr NoiseTerms stationary{NoiseTerm::white,        NoiseTerm::random_walk, NoiseTerm::bias_instability,
                                NoiseTerm::quantization, NoiseTerm::rate_ramp,   NoiseTerm::gauss_markov};

std::vector<double> white(std::uint64_t seed) {
  return simulated({.n = size, .rate = rate, .white = 0.02, .seed = seed});
}

/// The gaps of a selection in Hz.
std::vector<Interval<double>> gaps_of(const Selection& selection, const LogFit& log) {
  std::vector<Interval<double>> gaps;
  for (const auto& [begin, end] : selection.gaps()) {
    gaps.push_back({log.pooled.bins()[begin].frequency, log.pooled.bins()[end - 1].frequency});
  }
  return gaps;
}

Selection without_misfits(const LogFit& log, NoiseTerms terms = stationary) {
  Selection selection(log.pooled, rate, {});
  selection.leave_out_misfits(terms);
  return selection;
}

}  // namespace

TEST_CASE("All is used but what is left out by hand") {
  const LogFit log(white(1), rate);
  const auto& bins = log.pooled.bins();
  const Selection all(log.pooled, rate / 2, {});
  CHECK(all.count() == bins.size());
  CHECK(all.used_end() == bins.size());
  CHECK(all.gaps().empty());

  const Selection some(log.pooled, 10, {{2, 3}, {2.5, 4}, {6, 6.5}});
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double f = bins[i].frequency;
    CHECK(some.included()[i] == (f <= 10 && !(f >= 2 && f <= 4) && !(f >= 6 && f <= 6.5)));
  }
  CHECK(static_cast<std::ptrdiff_t>(some.count()) == std::count(some.included().begin(), some.included().end(), true));
  CHECK(bins[some.used_end() - 1].frequency <= 10);
  CHECK(bins[some.used_end()].frequency > 10);
  const auto gaps = gaps_of(some, log);  // not what is above the highest
  REQUIRE(gaps.size() == 2);
  CHECK_THAT(gaps[0].lower, WithinAbs(2, 0.05));
  CHECK_THAT(gaps[0].upper, WithinAbs(4, 0.05));
  CHECK_THAT(gaps[1].lower, WithinAbs(6, 0.1));
  CHECK_THAT(gaps[1].upper, WithinAbs(6.5, 0.1));

  const Selection none(log.pooled, rate, {{0, rate}});
  CHECK(none.count() == 0);
  CHECK(none.used_end() == 0);
  CHECK(none.gaps().empty());
}

TEST_CASE("Gaps are runs of bins") {
  const LogFit log(white(1), rate);
  Selection selection(log.pooled, rate, {});
  const auto& bins = log.pooled.bins();
  selection.leave_out({200, 208, 6});
  // With a quarter on either side.
  CHECK(selection.gaps() == Gaps{{198, 210}});
  CHECK(selection.count() == bins.size() - 12);
  selection.reset();
  CHECK(selection.count() == bins.size());
  selection.leave_out({0, 1, 6});
  CHECK(selection.gaps() == Gaps{{0, 2}});
}

TEST_CASE("What is left out does not grow when something else is") {
  const LogFit log(white(1), rate);
  Selection selection(log.pooled, rate, {});
  selection.leave_out({100, 116, 6});
  CHECK(selection.gaps() == Gaps{{96, 120}});
  selection.leave_out({300, 304, 6});
  CHECK(selection.gaps() == Gaps{{96, 120}, {299, 305}});
}

TEST_CASE("At the upper end, what a filter bends an octave below goes, too") {
  const LogFit log(white(1), rate);
  const auto& bins = log.pooled.bins();
  Selection selection(log.pooled, rate, {});
  selection.leave_out({bins.size() - 20, bins.size() - 4, -6});
  CHECK(selection.used_end() < bins.size());
  CHECK_THAT(bins[selection.used_end() - 1].frequency, WithinRel(bins[bins.size() - 20].frequency / 2, 0.05));
  CHECK(selection.gaps().empty());
}

TEST_CASE("Good logs are used as they are") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto y = white(seed);
    if (seed % 3 == 1) y = simulated({.n = size, .rate = rate, .white = 0.02, .walk = 5e-3, .seed = seed});
    if (seed % 3 == 2) add_gauss_markov(y, rate, 0.03, 10, seed);
    const LogFit log(y, rate);
    const Selection selection = without_misfits(log);
    CHECK(selection.count() == log.pooled.bins().size());
  }
}

TEST_CASE("A line is left out with little beside it") {
  for (const double frequency : {0.05, 0.6, 3.0, 20.0}) {
    for (const std::uint64_t seed : {1U, 2U}) {
      INFO(frequency << " Hz, seed " << seed);
      auto y = white(seed);
      add_line(y, rate, 0.05, frequency);
      const LogFit log(y, rate);
      const Selection selection = without_misfits(log);
      const auto gaps = gaps_of(selection, log);
      REQUIRE(gaps.size() == 1);
      // Not exactly: a bin has the mean of its frequencies. No more than half, as far as a strong line's power reaches,
      // and four coefficients, on either side.
      const double margin = frequency * 0.6 + 4 * rate / (2 * size);
      CHECK(gaps[0].lower <= frequency * 1.01);
      CHECK(gaps[0].upper >= frequency * 0.99);
      CHECK(gaps[0].lower >= frequency - margin);
      CHECK(gaps[0].upper <= frequency + margin);
      CHECK(selection.used_end() == log.pooled.bins().size());
    }
  }
}

TEST_CASE("A resonance is left out, and what is on either side stays") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    auto y = white(seed);
    add_resonance(y, rate, 0.6, 10, 0.07, seed);
    const LogFit log(y, rate);
    const Selection selection = without_misfits(log);
    const auto& bins = log.pooled.bins();
    REQUIRE_FALSE(selection.gaps().empty());
    bool at_peak = false;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (std::abs(bins[i].frequency / 0.6 - 1) < 0.1) CHECK_FALSE(selection.included()[i]);
      at_peak = at_peak || std::abs(bins[i].frequency / 0.6 - 1) < 0.1;
      if (bins[i].frequency < 0.1 || bins[i].frequency > 2) CHECK(selection.included()[i]);
    }
    CHECK(at_peak);
  }
}

TEST_CASE("A low-pass filter loses its upper end and a margin") {
  for (const double share : {0.3, 0.6}) {
    auto y = white(3);
    low_pass(y, share);
    const LogFit log(y, rate);
    const Selection selection = without_misfits(log, {NoiseTerm::white});
    const double end = log.pooled.bins()[selection.used_end() - 1].frequency;
    INFO(share << ": up to " << end << " Hz");
    // |H|² = s²/(s² + 4(1 − s) sin²(πf/rate)): at the end hardly less than 1.
    const double sine = std::sin(std::numbers::pi * end / rate);
    CHECK(share * share / (share * share + 4 * (1 - share) * sine * sine) > 0.8);
    CHECK(end > 0.2);
    CHECK(selection.gaps().empty());
  }
}

TEST_CASE("What was left out by hand stays out") {
  auto y = white(4);
  add_line(y, rate, 0.05, 3);
  const LogFit log(y, rate);
  Selection selection(log.pooled, 20, {{2.5, 3.5}});
  const auto by_hand = selection.included();
  selection.leave_out_misfits(stationary);
  CHECK(selection.included() == by_hand);  // nothing else is off
  selection.leave_out({100, 116, 6});
  CHECK(selection.count() < static_cast<std::size_t>(std::count(by_hand.begin(), by_hand.end(), true)));
  selection.reset();
  CHECK(selection.included() == by_hand);
}

TEST_CASE("The octave at the top does not win against all others") {
  // It has half of all numbers and twice the power: it goes, not the rest.
  auto y = white(5);
  scale_power(y, rate, 12.5, 25, 2);
  const LogFit log(y, rate);
  const Selection selection = without_misfits(log, {NoiseTerm::white});
  const auto& bins = log.pooled.bins();
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (bins[i].frequency < 5) CHECK(selection.included()[i]);
    if (bins[i].frequency > 13) CHECK_FALSE(selection.included()[i]);
  }
}
