// SPDX-License-Identifier: MIT
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <splinertia/allan/analysis.hpp>
#include <splinertia/allan/curve.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "allan/disturbances.hpp"
#include "allan/simulated.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Values = std::vector<double>;
using Result = Analysis<double>;
constexpr std::size_t size = 120'000;  // 20 minutes at 100 Hz
constexpr double rate = 100, density = 1e-3, deviation = 0.01;
constexpr NoiseTerm N = NoiseTerm::white, K = NoiseTerm::random_walk, B = NoiseTerm::bias_instability,
                    Q = NoiseTerm::quantization, R = NoiseTerm::rate_ramp, G = NoiseTerm::gauss_markov,
                    W = NoiseTerm::warm_up;

Values log_with(std::uint64_t seed, double walk = 0, double ramp = 0) {
  return simulated({.n = size, .rate = rate, .white = density, .walk = walk, .ramp = ramp, .seed = seed, .mean = 0.1});
}

void check_undetected(const Result& result, std::initializer_list<NoiseTerm> terms) {
  for (const NoiseTerm term : terms) {
    INFO(symbol(term));
    CHECK_FALSE(result.noise[term].detected);
    CHECK(result.noise[term].interval.lower == 0);
    CHECK(result.noise[term].one_sigma.lower == 0);
  }
}

void check_white_noise(const Result& result, double share = 0.01) {
  CHECK(result.noise.N.detected);
  CHECK_THAT(result.noise.N.value, WithinRel(density, share));
}

}  // namespace

TEST_CASE("A good log is adequate") {
  int walks = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const Values y = log_with(seed, 5e-4);
    const Result result = analyse(y, rate);
    CHECK(result.adequacy() == Adequacy::adequate);
    CHECK(result.misfits.empty());
    CHECK(result.steps.empty());
    CHECK(result.freezes.empty());
    CHECK_FALSE(result.resolution.has_value());
    CHECK(result.rounding == RoundingEffect::none);
    CHECK(result.used_to_the_end());
    check_white_noise(result);
    walks += result.noise.K.detected ? 1 : 0;  // in some logs it may forget
    CHECK((result.noise.K.detected || result.noise.K.possible));
    check_undetected(result, {B, Q, R, G, W});
    // The same curve and estimates as alone.
    const auto curve = overlapping(y, rate);
    REQUIRE(result.curve.points.size() == curve.points.size());
    CHECK(result.curve.points.back().deviation == curve.points.back().deviation);
    CHECK(result.noise.K.value == identify(y, rate).K.value);
  }
  CHECK(walks >= 2);
}

TEST_CASE("A step is found and is no walk") {
  struct Case {
    std::size_t sample;
    double height;  // standard deviations of a sample
    std::size_t duration;
  };
  // In the middle; on the border of blocks of any length; a tilt of 3 s.
  for (const Case& step : {Case{60'000, 1, 0}, Case{64'000, 20, 0}, Case{60'000, 5, 300}}) {
    for (const std::uint64_t seed : {1U, 2U}) {
      INFO(step.height << " deviations at " << step.sample << ", seed " << seed);
      Values y = log_with(seed);
      add_step(y, step.sample, step.height * deviation, step.duration);
      const Result result = analyse(y, rate);
      REQUIRE(result.steps.size() == 1);
      const double tolerance = 12 / step.height + 0.2 * static_cast<double>(step.duration);
      CHECK_THAT(static_cast<double>(result.steps[0].sample),
                 WithinAbs(static_cast<double>(step.sample + step.duration), 2 * tolerance));
      CHECK_THAT(result.steps[0].height, WithinAbs(step.height * deviation, 0.1 * step.height * deviation));
      CHECK(result.adequacy() == Adequacy::partial);
      check_white_noise(result, 0.02);
      check_undetected(result, {K, B, R, G, W});
      // What shows of it is a limit.
      CHECK((result.noise.K.possible || result.noise.B.possible || result.noise.G.possible || result.noise.W.possible));
      CHECK(result.noise.K.interval.upper > 0);
    }
  }
}

TEST_CASE("A freeze is found, and the log is inadequate") {
  for (const std::uint64_t seed : {1U, 2U}) {
    Values y = log_with(seed, 2e-4);
    freeze(y, 50'000, 10'000);
    const Result result = analyse(y, rate);
    REQUIRE(result.freezes.size() == 1);
    CHECK(result.freezes[0].begin == 50'000);
    CHECK(result.freezes[0].end == 60'000);
    CHECK(result.adequacy() == Adequacy::inadequate);
    check_undetected(result, {K, B, Q, R, G, W});
    for (const Step& step : result.steps) CHECK((step.sample <= 50'000 || step.sample >= 60'000));
  }
}

TEST_CASE("A ramp is no walk") {
  int named = 0, above = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    INFO("seed " << seed);
    // As strong as the white noise at a third of the log; and a strong one.
    const Result weak = analyse(log_with(seed, 0, 3e-7), rate), strong = analyse(log_with(seed, 0, 3e-6), rate);
    check_undetected(weak, {K, B, G});
    for (const auto& description : weak.noise.descriptions) named += description.terms.has(R) ? 1 : 0;
    above += weak.noise.R.interval.upper > 3e-7 ? 1 : 0;
    check_undetected(strong, {K, B, G, W});
    CHECK(strong.noise.R.detected);
    CHECK_THAT(strong.noise.R.value, WithinRel(3e-6, 0.1));
    CHECK(strong.adequacy() == Adequacy::adequate);
    CHECK(strong.steps.empty());
  }
  CHECK(named >= 4);
  CHECK(above >= 4);
}

TEST_CASE("Warming up is no walk") {
  for (const std::uint64_t seed : {1U, 2U}) {
    Values y = log_with(seed);
    add_warm_up(y, rate, 3 * deviation, 200);
    const Result result = analyse(y, rate);
    check_undetected(result, {K, B, R, G});
    CHECK(result.noise.W.detected);
    CHECK_THAT(result.noise.W.value, WithinRel(3 * deviation, 0.1));
    CHECK_THAT(result.noise.W.time, WithinRel(200, 0.15));
    CHECK(result.adequacy() == Adequacy::adequate);
  }
}

TEST_CASE("A bias that forgets is named, and the model goes through the curve") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    // Its peak is three times the white noise there: 0.44 σ at 1.9 T, where N is 1e-3/√19.
    Values y = log_with(seed);
    add_gauss_markov(y, rate, 3 * density / std::sqrt(19) / 0.437, 10, seed);
    const Result result = analyse(y, rate);
    INFO("seed " << seed);
    CHECK(result.noise.G.detected);
    check_undetected(result, {K, B, Q, R, W});
    check_white_noise(result);
    CHECK(result.misfits.empty());
    CHECK(result.adequacy() == Adequacy::adequate);
  }
}

TEST_CASE("A resonance is left out, and the log is partly described") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Values y = log_with(seed);
    add_resonance(y, rate, 0.6, 10, deviation / 2, seed);
    const Result result = analyse(y, rate);
    INFO("seed " << seed);
    check_white_noise(result);
    check_undetected(result, {K, B, Q, R, G, W});
    CHECK(result.noise.Q.interval.upper < density / std::sqrt(3 * rate));  // what all of a sample's noise could be
    CHECK(result.used_to_the_end());
    CHECK(result.adequacy() == Adequacy::partial);
    CHECK_FALSE(result.misfits.empty());  // the curve has what was left out
    for (const auto& misfit : result.misfits) CHECK(misfit.ratio > 1);
  }
}

TEST_CASE("Where a filter's end is left out the log is partly described") {
  Values y = log_with(1);
  low_pass(y, 0.4);
  const Result result = analyse(y, rate);
  CHECK_FALSE(result.used_to_the_end());
  CHECK(result.adequacy() == Adequacy::partial);
  CHECK(analyse(log_with(1), rate, {.highest_frequency = 20}).adequacy() == Adequacy::partial);
}

TEST_CASE("Rounding is told by what it does") {
  for (const auto& [resolution, effect] :
       {std::pair{0.3, RoundingEffect::none}, {1.0, RoundingEffect::slight}, {4.0, RoundingEffect::invalid}}) {
    INFO(resolution << " deviations");
    Values y = log_with(1);
    round_to(y, resolution * deviation);
    const Result result = analyse(y, rate);
    REQUIRE(result.resolution.has_value());
    CHECK_THAT(*result.resolution, WithinRel(resolution * deviation, 1e-6));
    CHECK(result.rounding == effect);
    CHECK(result.adequacy() == (effect == RoundingEffect::invalid ? Adequacy::inadequate : Adequacy::adequate));
    check_undetected(result, {K, B, Q, R, G, W});
  }
}

TEST_CASE("What does not fit is inadequate, and only white noise is detected") {
  Values y = log_with(1, 2e-4);
  add_resonance(y, rate, 0.6, 10, deviation, 1);
  const Result result = analyse(y, rate, {.exclude_misfits = false});
  CHECK_FALSE(result.noise.fits);
  CHECK(result.adequacy() == Adequacy::inadequate);
  check_undetected(result, {K, B, Q, R, G, W});
}

TEST_CASE("Adequacy by what is wrong") {
  Result result{.curve = {}, .noise = {}};
  result.curve.rate = rate;
  result.noise.highest_frequency = rate / 2;
  result.noise.fits = true;
  CHECK(result.adequacy() == Adequacy::adequate);
  const auto with = [&](const auto& change) {
    Result changed = result;
    change(changed);
    return changed.adequacy();
  };
  CHECK(with([](Result& r) { r.noise.fits = false; }) == Adequacy::inadequate);
  CHECK(with([](Result& r) { r.freezes.push_back({0, 100}); }) == Adequacy::inadequate);
  CHECK(with([](Result& r) { r.rounding = RoundingEffect::invalid; }) == Adequacy::inadequate);
  CHECK(with([](Result& r) { r.rounding = RoundingEffect::slight; }) == Adequacy::adequate);
  CHECK(with([](Result& r) { r.misfits.push_back({}); }) == Adequacy::inadequate);
  CHECK(with([](Result& r) { r.steps.push_back({}); }) == Adequacy::partial);
  CHECK(with([](Result& r) { r.noise.excluded.push_back({}); }) == Adequacy::partial);
  CHECK(with([](Result& r) { r.noise.highest_frequency = r.curve.rate / 3; }) == Adequacy::partial);
  CHECK(with([](Result& r) { r.stillness.disturbed = 1; }) == Adequacy::partial);
  const auto both = [](Result& r) {
    r.steps.push_back({});
    r.noise.fits = false;
  };
  CHECK(with(both) == Adequacy::inadequate);
}

TEST_CASE("Withheld terms are possible, from zero on") {
  NoiseEstimates<double> noise;
  for (const NoiseTerm term : noise_terms) {
    noise[term].value = 2;
    noise[term].interval = {1, 3};
    noise[term].one_sigma = {1.5, 2.5};
  }
  noise.K.detected = noise.N.detected = noise.G.detected = true;
  noise.B.possible = true;
  withhold(noise, {K, B, R});
  for (const NoiseTerm term : {K, B, R}) {
    CHECK_FALSE(noise[term].detected);
    CHECK(noise[term].interval.lower == 0);
    CHECK(noise[term].one_sigma.lower == 0);
    CHECK(noise[term].interval.upper == 3);
    CHECK(noise[term].one_sigma.upper == 2.5);
    CHECK(noise[term].value == 2);
  }
  CHECK(noise.K.possible);  // it was detected
  CHECK(noise.B.possible);
  CHECK_FALSE(noise.R.possible);
  for (const NoiseTerm term : {N, G}) {
    CHECK(noise[term].detected);
    CHECK(noise[term].interval.lower == 1);
    CHECK_FALSE(noise[term].possible);
  }
}

TEST_CASE("Other scalars have the same analysis, and bad logs are refused") {
  const Values y = simulated({.n = 20'000, .rate = rate, .white = density, .walk = 1e-3, .seed = 1});
  const std::vector<long double> wide(y.begin(), y.end());
  const auto more = analyse(wide, 100.0L);
  STATIC_CHECK(std::same_as<decltype(more), const Analysis<long double>>);
  const Result result = analyse(y, rate);
  CHECK(more.adequacy() == result.adequacy());
  CHECK_THAT(static_cast<double>(more.noise.K.value), WithinRel(result.noise.K.value, 1e-3));
  CHECK_THROWS_AS(analyse(y, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(analyse(Values{1, 2}, rate), std::invalid_argument);
  CHECK_THROWS_AS(analyse(y, rate, {.confidence = 2}), std::invalid_argument);
}
