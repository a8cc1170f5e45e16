// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <splinertia/allan/detail/model/model_estimates.hpp>
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

using Estimates = NoiseEstimates<double>;
using Selection = ModelSelection<double>;
using Values = std::vector<double>;
constexpr std::size_t size = 20'000;
constexpr double rate = 50;

Values log_with(std::uint64_t seed, double walk = 0, double ramp = 0, double quantization = 0) {
  return simulated(
      {.n = size, .rate = rate, .white = 0.02, .walk = walk, .quantization = quantization, .ramp = ramp, .seed = seed});
}

Values biased(std::uint64_t seed, double deviation = 0.06, double time = 10) {
  Values y = log_with(seed);
  add_gauss_markov(y, rate, deviation, time, seed);
  return y;
}

Values warming(std::uint64_t seed, double height, double time) {
  Values y = log_with(seed);
  add_warm_up(y, rate, height, time);
  return y;
}

struct Estimated {
  /// The spectrum agrees with the model, or not, and these bands were left out.
  Estimated(const Values& y, bool fits = true, const std::vector<BandFit<double>>& excluded = {},
            NoiseTerms candidates = NoiseTerms::all(), double confidence = 0.95)
      : log(y, rate), selection(log.fit, candidates) {
    result.fits = fits;
    result.excluded = excluded;
    ModelEstimates<double>(selection, confidence, candidates).write_to(result);
  }

  LogFit log;
  Selection selection;
  Estimates result;
};

/// Within five standard errors.
void check_value(const Estimate<double>& estimate, double truth) {
  CHECK(estimate.detected);
  CHECK_FALSE(estimate.possible);
  CHECK_THAT(estimate.value, WithinAbs(truth, 5 * estimate.standard_error()));
  CHECK(estimate.interval.lower < estimate.one_sigma.lower);
  CHECK(estimate.one_sigma.lower < estimate.value);
  CHECK(estimate.value < estimate.one_sigma.upper);
  CHECK(estimate.one_sigma.upper < estimate.interval.upper);
  CHECK(estimate.standard_error() < 0.4 * truth);
}

void check_nothing(const Estimate<double>& estimate) {
  CHECK_FALSE(estimate.detected);
  CHECK_FALSE(estimate.possible);
  CHECK(estimate.value == 0);
  CHECK(estimate.interval.upper == 0);
  CHECK(estimate.one_sigma.upper == 0);
}

}  // namespace

TEST_CASE("A ramp and a warm-up are trends") {
  STATIC_CHECK(has_trend({NoiseTerm::white, NoiseTerm::rate_ramp}));
  STATIC_CHECK(has_trend({NoiseTerm::warm_up}));
  STATIC_CHECK_FALSE(has_trend(NoiseTerms::all().without(NoiseTerm::rate_ramp).without(NoiseTerm::warm_up)));
}

TEST_CASE("Estimates are in the units of the signal") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    INFO("seed " << seed);
    const Estimated walk(log_with(seed, 0.02)), ramp(log_with(seed, 0, 2e-3)), rounded(log_with(seed, 0, 0, 2e-3));
    check_value(walk.result.N, 0.02);
    check_value(walk.result.K, 0.02);
    check_value(ramp.result.R, 2e-3);
    check_value(rounded.result.Q, 2e-3);
    const Estimated bias(biased(seed, 0.06, 5)), warm(warming(seed, -0.3, 60));
    check_value(bias.result.G, 0.06);
    check_value(warm.result.W, 0.3);
    CHECK(bias.result.G.time_interval.lower < bias.result.G.time);
    CHECK(bias.result.G.time < bias.result.G.time_interval.upper);
    CHECK_THAT(std::log(bias.result.G.time / 5), WithinAbs(0, 1));
    CHECK_THAT(warm.result.W.time,
               WithinAbs(60, 2.5 * (warm.result.W.time_interval.upper - warm.result.W.time_interval.lower)));
    // The best description says the same, in the same units.
    const auto& best = bias.result.descriptions.front();
    CHECK(best.terms == NoiseTerms{NoiseTerm::white, NoiseTerm::gauss_markov});
    CHECK(best.cost == 0);
    CHECK_THAT(best.value(NoiseTerm::white), WithinRel(bias.result.N.value, 1e-3));
    CHECK_THAT(best.value(NoiseTerm::gauss_markov), WithinRel(bias.result.G.value, 0.1));
    CHECK(best.correlation_time == bias.result.G.time);
    CHECK(best.decay_time == 0);
    const auto& settling = warm.result.descriptions.front();
    CHECK(settling.value(NoiseTerm::warm_up) == warm.result.W.value);
    CHECK(settling.decay_time == warm.result.W.time);
    CHECK(settling.correlation_time == 0);
  }
}

TEST_CASE("The interval of a bias and of its time hold the truth") {
  constexpr int logs = 30;
  int deviation = 0, time = 0;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const Estimates result = Estimated(biased(seed, 0.06, 5)).result;
    const auto& G = result.G;
    deviation += G.interval.lower <= 0.06 && 0.06 <= G.interval.upper ? 1 : 0;
    time += G.time_interval.lower <= 5 && 5 <= G.time_interval.upper ? 1 : 0;
  }
  // Five standard deviations of 95 %.
  CHECK(deviation >= 23);
  CHECK(time >= 23);
}

TEST_CASE("What is not in a log has a limit, and a time of its own has none") {
  const Estimates result = Estimated(log_with(1)).result;
  for (const NoiseTerm term :
       {NoiseTerm::random_walk, NoiseTerm::bias_instability, NoiseTerm::quantization, NoiseTerm::rate_ramp}) {
    INFO(symbol(term));
    CHECK_FALSE(result[term].detected);
    CHECK_FALSE(result[term].possible);
    CHECK(result[term].interval.lower == 0);
    CHECK(result[term].one_sigma.lower == 0);
    CHECK(result[term].interval.upper > result[term].one_sigma.upper);
    CHECK(result[term].one_sigma.upper > 0);
  }
  check_nothing(result.G);
  check_nothing(result.W);
  CHECK(result.G.time == 0);
  CHECK(result.W.time_interval.upper == 0);
  CHECK(result.least_correlation_time == 0);
}

TEST_CASE("What only some descriptions have is possible, from zero on") {
  int possible = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Estimated estimated(log_with(seed, 6e-4));
    const auto& K = estimated.result.K;
    if (!K.possible) continue;
    ++possible;
    CHECK_FALSE(K.detected);
    CHECK(K.interval.lower == 0);
    CHECK(K.one_sigma.lower == 0);
    CHECK(K.interval.upper > 6e-4);
    CHECK(K.value > 0);
    // As wide as what each description says.
    for (const auto& description : estimated.result.descriptions) {
      CHECK(description.value(NoiseTerm::random_walk) < K.interval.upper);
      CHECK(description.cost >= 0);
      CHECK(description.cost <= 6);
    }
  }
  CHECK(possible >= 3);
}

TEST_CASE("Of what is no candidate nothing is said") {
  constexpr NoiseTerms candidates{NoiseTerm::white, NoiseTerm::bias_instability};
  const Estimates result = Estimated(log_with(1, 0.02), true, {}, candidates).result;
  for (const NoiseTerm term : noise_terms) {
    if (!candidates.has(term)) check_nothing(result[term]);
  }
  CHECK(result.B.detected);
}

TEST_CASE("Where the model does not hold, nothing but white noise is called detected") {
  for (const Values& y : {log_with(1, 0.02), biased(1), warming(1, 0.3, 60), log_with(1, 0, 1e-3)}) {
    const Estimates good = Estimated(y).result, bad = Estimated(y, false).result;
    CHECK(bad.N.detected);
    for (const NoiseTerm term : noise_terms) {
      if (term == NoiseTerm::white) continue;
      CHECK_FALSE(bad[term].detected);
      CHECK(bad[term].possible == (good[term].detected || good[term].possible));
      CHECK(bad[term].interval.lower == 0);
      CHECK(bad[term].interval.upper == good[term].interval.upper);
      CHECK(bad[term].value == good[term].value);
    }
    CHECK(bad.least_correlation_time == 0);
  }
}

TEST_CASE("What was left out can look like a slow term") {
  const auto around = [](double frequency, double ratio = 10) {
    return std::vector<BandFit<double>>{{{frequency / 1.2, frequency * 1.2}, ratio, 0.1}};
  };
  // Trends beside any band with another power; not one that has what it should, which was left out by hand.
  for (const Values& y : {warming(1, 0.3, 60), log_with(1, 0, 1e-3)}) {
    const NoiseTerm term = Estimated(y).result.W.detected ? NoiseTerm::warm_up : NoiseTerm::rate_ramp;
    CHECK(Estimated(y).result[term].detected);
    CHECK_FALSE(Estimated(y, true, around(5)).result[term].detected);
    CHECK(Estimated(y, true, around(5)).result[term].possible);
    CHECK(Estimated(y, true, around(5)).result[term].interval.lower == 0);
    CHECK_FALSE(Estimated(y, true, around(5, 0.1)).result[term].detected);
    CHECK(Estimated(y, true, around(5, 1.1)).result[term].detected);
  }
  // Others only where they are what there is: a bias of 10 s falls off from 1/(2πT) on, 0.016 Hz; a walk of 0.02 is
  // above white noise of 0.02 up to 0.16 Hz.
  const double corner = 1 / (2 * std::numbers::pi * 10);
  CHECK(Estimated(biased(1), true, around(10)).result.G.detected);
  CHECK_FALSE(Estimated(biased(1), true, around(corner * 2)).result.G.detected);
  CHECK(Estimated(biased(1), true, around(corner * 2)).result.G.possible);
  CHECK_FALSE(Estimated(biased(1), true, around(corner * 2, 0.1)).result.G.detected);
  CHECK(Estimated(biased(1), true, around(corner * 2, 0.9)).result.G.detected);
  CHECK(Estimated(log_with(1, 0.02), true, around(5)).result.K.detected);
  CHECK_FALSE(Estimated(log_with(1, 0.02), true, around(0.1)).result.K.detected);
  // White and quantization noise are no slow terms.
  const Estimates rounded = Estimated(log_with(1, 0, 0, 2e-3), true, around(0.1)).result;
  CHECK(rounded.N.detected);
  CHECK(rounded.Q.detected);
}

TEST_CASE("The interval of a warm-up's height and of its time hold the truth") {
  constexpr int logs = 30;
  int height = 0, time = 0;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const Estimates result = Estimated(warming(seed, 0.1, 80)).result;
    const auto& W = result.W;
    height += W.interval.lower <= 0.1 && 0.1 <= W.interval.upper ? 1 : 0;
    time += W.time_interval.lower <= 80 && 80 <= W.time_interval.upper ? 1 : 0;
  }
  CHECK(height >= 23);
  CHECK(time >= 23);
}

TEST_CASE("A walk that was detected may forget, but not sooner than is said") {
  const Estimated estimated(log_with(2, 0.02));
  REQUIRE(estimated.result.K.detected);
  const double time = estimated.result.least_correlation_time;
  const auto& best = estimated.selection.best();
  const auto& likelihood = estimated.log.likelihood;
  CHECK(time > likelihood.correlation_times().lower);
  CHECK(time < 4 * likelihood.correlation_times().upper);
  // A bias with the walk's growth in place of it, 3.84 less likely at the least time; to three bisections of an octave.
  constexpr NoiseTerms terms{NoiseTerm::white, NoiseTerm::gauss_markov};
  auto start = best.result;
  start.theta[4] = start.theta[1];
  const auto excess = [&](double value) {
    return likelihood.at(terms, {.correlation = value}, start).objective - best.result.objective;
  };
  CHECK(excess(time) <= 3.8415);
  CHECK(excess(time * std::exp2(-0.125)) > 3.841);
  // A bias of that time and longer is what the log may have.
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Estimates result = Estimated(biased(seed, 0.2, 100)).result;
    held += !result.K.detected || result.least_correlation_time < 100 ? 1 : 0;
  }
  CHECK(held >= 9);
}

TEST_CASE("More confidence is a wider interval") {
  const Estimates usual = Estimated(log_with(1, 0.02)).result;
  const Estimates more = Estimated(log_with(1, 0.02), true, {}, NoiseTerms::all(), 0.999).result;
  for (const NoiseTerm term : {NoiseTerm::white, NoiseTerm::random_walk, NoiseTerm::rate_ramp}) {
    INFO(symbol(term));
    CHECK(more[term].interval.upper > usual[term].interval.upper);
    CHECK_THAT(more[term].one_sigma.upper, WithinRel(usual[term].one_sigma.upper, 1e-9));
    CHECK(more[term].value == usual[term].value);
  }
}

TEST_CASE("The limit of a ramp is widened by a walk that does not show") {
  // Of white noise alone the slope's error is 2√3 N/duration^1.5; its limit allows for a walk.
  const double duration = size / rate, error = std::sqrt(12.0) * 0.02 / std::pow(duration, 1.5);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto& R = Estimated(log_with(seed, 0, 1e-3)).result.R;
    CHECK(R.standard_error() > 0.95 * error);
    CHECK(std::abs(R.value - 1e-3) < 5 * error);
  }
}
