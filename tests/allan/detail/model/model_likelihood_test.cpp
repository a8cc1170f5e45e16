// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <splinertia/allan/detail/model/model_likelihood.hpp>
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

using Likelihood = ModelLikelihood<double>;
using Result = Likelihood::Result;
using Fit = Likelihood::Fit;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr NoiseTerms white_and_bias{NoiseTerm::white, NoiseTerm::gauss_markov};
constexpr NoiseTerms white_and_warm_up{NoiseTerm::white, NoiseTerm::warm_up};

bool holds(const Interval<double>& range, double time) { return range.lower <= time && time <= range.upper; }

/// A set that a model can have: a ramp is a warm-up that never ends.
bool has_one_trend(NoiseTerms terms) { return !(terms.has(NoiseTerm::rate_ramp) && terms.has(NoiseTerm::warm_up)); }

/// 400 s at 50 Hz of white noise and a Gauss–Markov bias of 8 s.
std::vector<double> biased(std::uint64_t seed) {
  auto y = simulated({.n = 20'000, .rate = 50, .white = 0.02, .seed = seed});
  add_gauss_markov(y, 50, 0.03, 8, seed);
  return y;
}

}  // namespace

TEST_CASE("A model with more terms is never less likely") {
  for (const std::uint64_t seed : {1U, 2U}) {
    auto y = simulated({.n = 500, .rate = 10, .white = 1, .walk = 0.1, .quantization = 0.05, .seed = seed});
    if (seed == 2) add_warm_up(y, 10, 3, 20);
    const LogFit log(y, 10);
    std::vector<Result> results(NoiseTerms::sets);
    for (unsigned number = 1; number < NoiseTerms::sets; ++number) {
      const NoiseTerms terms = NoiseTerms::numbered(number);
      if (!has_one_trend(terms)) continue;
      results[number] = log.likelihood.maximise(terms);
    }
    for (unsigned number = 1; number < NoiseTerms::sets; ++number) {
      for (const NoiseTerm term : noise_terms) {
        const NoiseTerms terms = NoiseTerms::numbered(number), more = terms.with(term);
        if (terms.has(term) || !has_one_trend(more)) continue;
        INFO("seed " << seed << ": " << symbols(terms) << " and " << symbol(term));
        const Result larger = log.likelihood.maximise(more, &results[number]);
        CHECK(larger.objective <= results[number].objective + 1e-6);
        CHECK(larger.objective <= results[more.number()].objective + 1e-6);
      }
    }
  }
}

TEST_CASE("Times are those of the terms, within what a log can show") {
  const LogFit log(biased(1), 50);
  // 32 samples to a quarter of the log; a two-hundredth of the log to eight times the log.
  CHECK_THAT(log.likelihood.correlation_times().lower, WithinRel(32 / 50.0, 1e-12));
  CHECK_THAT(log.likelihood.correlation_times().upper, WithinRel(100.0, 1e-12));
  CHECK_THAT(log.likelihood.decay_times().lower, WithinRel(2.0, 1e-12));
  CHECK_THAT(log.likelihood.decay_times().upper, WithinRel(3200.0, 1e-12));
  for (unsigned number = 1; number < NoiseTerms::sets; ++number) {
    const NoiseTerms terms = NoiseTerms::numbered(number);
    if (!has_one_trend(terms)) continue;
    INFO(symbols(terms));
    const Result result = log.likelihood.maximise(terms);
    const bool correlated = terms.has(NoiseTerm::gauss_markov), decays = terms.has(NoiseTerm::warm_up);
    if (correlated) CHECK(holds(log.likelihood.correlation_times(), result.times.correlation));
    if (!correlated) CHECK(result.times.correlation == 0);
    if (decays) CHECK(holds(log.likelihood.decay_times(), result.times.decay));
    if (!decays) CHECK(result.times.decay == infinity);
    CHECK((result.slope_error > 0) == (decays || terms.has(NoiseTerm::rate_ramp)));
    for (const NoiseTerm term : Fit::spectral_terms) {
      if (!terms.has(term)) CHECK(result.theta[Fit::index_of(term)] == 0);
    }
  }
}

TEST_CASE("Of few samples and of many, the times have a range") {
  const LogFit few(simulated({.n = 20, .rate = 50, .white = 1, .seed = 1}), 50);
  CHECK(few.likelihood.correlation_times().upper >= 2 * few.likelihood.correlation_times().lower);
  CHECK(few.likelihood.decay_times().upper >= 2 * few.likelihood.decay_times().lower);
  // Of a long log, a ten-thousandth of it, since vibration is shorter.
  const LogFit many(simulated({.n = 400'000, .rate = 50, .white = 1, .seed = 1}), 50);
  const double duration = many.pooled.duration();
  CHECK_THAT(many.likelihood.correlation_times().lower, WithinRel(duration / 10'000, 1e-12));
}

TEST_CASE("The times are recovered") {
  double correlation = 0, decay = 0;
  constexpr int logs = 12;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const LogFit log(biased(seed), 50);
    correlation += std::log(log.likelihood.maximise(white_and_bias).times.correlation / 8) / logs;
    auto y = simulated({.n = 20'000, .rate = 50, .white = 0.02, .seed = seed});
    add_warm_up(y, 50, -0.2, 60);
    const LogFit warming(y, 50);
    const Result result = warming.likelihood.maximise(white_and_warm_up);
    decay += std::log(result.times.decay / 60) / logs;
    // The slope at the beginning, a sample.
    CHECK_THAT(result.slopes[0] * warming.pooled.unit(), WithinRel(0.2 / (60 * 50), 0.3));
  }
  // A bias's time is known to some 25 % of fifty of them, a warm-up's to 5 %.
  CHECK(std::abs(correlation) < 5 * 0.25 / std::sqrt(logs));
  CHECK(std::abs(decay) < 5 * 0.05 / std::sqrt(logs));
}

TEST_CASE("No time next to the one found is more likely") {
  const LogFit log(biased(3), 50);
  const Result best = log.likelihood.maximise(white_and_bias);
  for (double time = 0.64; time < 100; time *= 1.1) {
    INFO(time << " s");
    const Result result = log.likelihood.at(white_and_bias, {.correlation = time}, best);
    CHECK(result.times.correlation == time);
    CHECK(result.objective >= best.objective - 1e-3);
  }
}

TEST_CASE("From a perturbed start, the same maximum is found") {
  const LogFit log(biased(4), 50);
  const Result best = log.likelihood.maximise(white_and_bias);
  for (const double factor : {0.2, 0.7, 1.5, 5.0}) {
    for (const double time_factor : {0.4, 1.0, 2.5}) {
      Result start = best;
      start.theta *= factor;
      start.times.correlation *= time_factor;
      const Result found = log.likelihood.maximum_near(white_and_bias, start);
      INFO(factor << " times the power, " << time_factor << " times the time");
      CHECK_THAT(found.objective, WithinAbs(best.objective, 2e-3));
      CHECK_THAT(found.times.correlation, WithinRel(best.times.correlation, 0.03));
    }
  }
}

TEST_CASE("A start without a term leads to the model with it") {
  const LogFit log(biased(5), 50);
  const Result white = log.likelihood.maximise({NoiseTerm::white});
  const Result best = log.likelihood.maximise(white_and_bias);
  // Two parabolas end within a tenth of a standard error of the time: 0.1² in −2·log-likelihood.
  CHECK_THAT(log.likelihood.maximum_near(white_and_bias, white).objective, WithinAbs(best.objective, 1e-2));
  // And a start with another term to the model without it.
  CHECK_THAT(log.likelihood.maximum_near({NoiseTerm::white}, best).objective, WithinAbs(white.objective, 1e-6));
}

TEST_CASE("A coefficient that is held stays") {
  const LogFit log(biased(6), 50);
  const Result best = log.likelihood.maximise(white_and_bias);
  const int white = Fit::index_of(NoiseTerm::white), bias = Fit::index_of(NoiseTerm::gauss_markov);
  for (const double factor : {0.0, 0.5, 1.0, 3.0}) {
    const double theta = best.theta[white] * factor;
    const Result held = log.likelihood.maximum_near(white_and_bias, best, [theta](const Likelihood::Times&) {
      return std::optional<Likelihood::Fixed>({NoiseTerm::white, theta});
    });
    CHECK(held.theta[white] == theta);
    CHECK(held.objective >= best.objective - 1e-3);
    // A standard deviation that is held: θ times the time.
    const double square = best.theta[bias] * best.times.correlation * factor;
    const Result deviation =
        log.likelihood.maximum_near(white_and_bias, best, [square](const Likelihood::Times& times) {
          return std::optional<Likelihood::Fixed>({NoiseTerm::gauss_markov, square / times.correlation});
        });
    CHECK_THAT(deviation.theta[bias] * deviation.times.correlation, WithinRel(square, 1e-12));
    CHECK(deviation.objective >= best.objective - 1e-3);
    if (factor == 1) {
      CHECK_THAT(held.objective, WithinAbs(best.objective, 1e-3));
      CHECK_THAT(deviation.objective, WithinAbs(best.objective, 1e-3));
    } else {
      CHECK(held.objective > best.objective + 1);
      CHECK(deviation.objective > best.objective + 1);
    }
  }
}
