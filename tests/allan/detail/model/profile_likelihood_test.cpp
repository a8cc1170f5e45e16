// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/model/profile_likelihood.hpp>
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
using Times = Likelihood::Times;
using Profile = ProfileLikelihood<double>;
using Fit = Likelihood::Fit;
constexpr NoiseTerms white_and_walk{NoiseTerm::white, NoiseTerm::random_walk};
constexpr NoiseTerms white_and_bias{NoiseTerm::white, NoiseTerm::gauss_markov};

std::vector<double> walking(std::size_t n = 4000) {
  return simulated({.n = n, .rate = 50, .white = 0.02, .walk = 0.01, .seed = 1});
}

std::vector<double> biased() {
  auto y = simulated({.n = 20'000, .rate = 50, .white = 0.02, .seed = 2});
  add_gauss_markov(y, 50, 0.04, 5, 2);
  return y;
}

/// The level that an interval's ends have, from where the level of 1 is: with Bartlett's factor for a root of which the
/// relative error is `error`.
double level(double confidence, double error) {
  return chi_square_quantile(confidence, 1.0) * (1 + 2 * std::min(error * error, 0.5) / 3);
}

/// Where a function of a root crosses a level above its centre, by bisection.
template <typename Excess>
double crossing_above(const Excess& excess, double centre, double level) {
  double inside = centre, outside = centre;
  do outside *= 1.25;
  while (excess(outside) < level);
  for (int i = 0; i < 40; ++i) {
    const double middle = (inside + outside) / 2;
    (excess(middle) < level ? inside : outside) = middle;
  }
  return inside;
}

/// That −2·log-likelihood with √θ or the deviation held is as much higher at both ends as it should be.
template <typename Excess>
void check_ends(const Interval<double>& interval, double centre, double confidence, const Excess& excess) {
  const double error = crossing_above(excess, centre, 1) / centre - 1;
  const double expected = level(confidence, error);
  CHECK(interval.lower < centre);
  CHECK(interval.upper > centre);
  CHECK_THAT(excess(interval.upper), WithinRel(expected, 2e-3));
  if (interval.lower > 0) CHECK_THAT(excess(interval.lower), WithinRel(expected, 2e-3));
  if (interval.lower == 0) CHECK(excess(0) <= expected);
}

}  // namespace

TEST_CASE("The interval of white noise alone is that of a scale") {
  for (const std::size_t n : {12U, 60U, 1000U}) {
    const LogFit log(simulated({.n = n, .rate = 50, .white = 1, .seed = 3}), 50);
    const Result best = log.likelihood.maximise({NoiseTerm::white});
    const double count = static_cast<double>(log.pooled.samples() - 1), centre = std::sqrt(best.theta[0]);
    // count·(log r + 1/r − 1), r the ratio of θ to its most likely value.
    const auto excess = [&](double root) {
      const double ratio = root * root / best.theta[0];
      return count * (std::log(ratio) + 1 / ratio - 1);
    };
    for (const double confidence : {0.5, 0.95, 0.999}) {
      INFO(n << " samples, confidence " << confidence);
      const auto interval = Profile(log.likelihood, {NoiseTerm::white}, best).root(NoiseTerm::white, confidence);
      CHECK(interval.lower > 0);
      check_ends(interval, centre, confidence, excess);
    }
  }
}

TEST_CASE("A log that says nothing of a coefficient does not limit it") {
  const LogFit log(walking(100), 50);
  const Fit fit(log.pooled, std::vector<bool>(log.pooled.bins().size(), false));
  const Likelihood likelihood(fit);
  const auto interval =
      Profile(likelihood, {NoiseTerm::white}, likelihood.maximise({NoiseTerm::white})).root(NoiseTerm::white, 0.95);
  CHECK(interval.lower == 0);
  CHECK(interval.upper == std::numeric_limits<double>::infinity());
}

TEST_CASE("At the ends of a coefficient's interval the likelihood is lower by its level") {
  const LogFit log(walking(), 50);
  const Result best = log.likelihood.maximise(white_and_walk);
  const Profile profile(log.likelihood, white_and_walk, best);
  for (const NoiseTerm term : {NoiseTerm::white, NoiseTerm::random_walk}) {
    INFO(symbol(term));
    const auto excess = [&](double root) {
      return log.fit.maximise(white_and_walk, {}, Fit::Fixed{term, root * root}).objective - best.objective;
    };
    for (const double confidence : {0.6827, 0.95}) {
      check_ends(profile.root(term, confidence), std::sqrt(best.theta[Fit::index_of(term)]), confidence, excess);
    }
    const auto narrow = profile.root(term, 0.6827), wide = profile.root(term, 0.95);
    CHECK(wide.lower < narrow.lower);
    CHECK(wide.upper > narrow.upper);
  }
}

TEST_CASE("At the ends of a bias's interval the likelihood is lower by its level") {
  const LogFit log(biased(), 50);
  const Result best = log.likelihood.maximise(white_and_bias);
  const Profile profile(log.likelihood, white_and_bias, best);
  const double centre = std::sqrt(best.theta[Fit::index_of(NoiseTerm::gauss_markov)] * best.times.correlation);
  // The most likely time for each deviation by golden ratio search: the profile likelihood has one minimum.
  const auto excess = [&](double root) {
    const auto at = [&](double logarithm) {
      const double time = std::exp(logarithm);
      const Fit::Fixed held{NoiseTerm::gauss_markov, root * root / time};
      return log.fit.maximise(white_and_bias, {.correlation = time}, held, &best.theta).objective;
    };
    double lower = std::log(0.64), upper = std::log(100.0);
    for (int i = 0; i < 25; ++i) {
      const double left = upper - (upper - lower) * 0.618, right = lower + (upper - lower) * 0.618;
      if (at(left) < at(right)) {
        upper = right;
      } else {
        lower = left;
      }
    }
    return at((lower + upper) / 2) - best.objective;
  };
  const auto interval = profile.gauss_markov_root(0.95);
  CHECK(interval.lower > 0);
  check_ends(interval, centre, 0.95, excess);
}

TEST_CASE("At the ends of a time's interval the likelihood is lower by its level, or its range ends") {
  const LogFit log(biased(), 50);
  const Result best = log.likelihood.maximise(white_and_bias);
  const Profile profile(log.likelihood, white_and_bias, best);
  const auto excess = [&](double time) {
    return log.likelihood.at(white_and_bias, {.correlation = time}, best).objective - best.objective;
  };
  for (const double confidence : {0.6827, 0.95}) {
    const auto interval = profile.time(&Times::correlation, log.likelihood.correlation_times(), confidence);
    const double level = chi_square_quantile(confidence, 1.0);
    CHECK(interval.lower < best.times.correlation);
    CHECK(interval.upper > best.times.correlation);
    CHECK_THAT(excess(interval.lower), WithinRel(level, 2e-3));
    CHECK_THAT(excess(interval.upper), WithinRel(level, 2e-3));
  }
  const double time = best.times.correlation;
  const auto cut = profile.time(&Times::correlation, {time / 1.01, time * 1.01}, 0.95);
  CHECK(cut.lower == time / 1.01);
  CHECK(cut.upper == time * 1.01);
}

TEST_CASE("The decay time of a warm-up has an interval") {
  auto y = simulated({.n = 20'000, .rate = 50, .white = 0.02, .seed = 3});
  add_warm_up(y, 50, 0.1, 50);
  const LogFit log(y, 50);
  constexpr NoiseTerms terms{NoiseTerm::white, NoiseTerm::warm_up};
  const Result best = log.likelihood.maximise(terms);
  const auto interval = Profile(log.likelihood, terms, best).time(&Times::decay, log.likelihood.decay_times(), 0.95);
  const double level = chi_square_quantile(0.95, 1.0);
  for (const double end : {interval.lower, interval.upper}) {
    CHECK_THAT(log.likelihood.at(terms, {.decay = end}, best).objective - best.objective, WithinRel(level, 2e-3));
  }
  CHECK(interval.lower < best.times.decay);
  CHECK(interval.upper > best.times.decay);
}

TEST_CASE("The interval of a term that a log does not show begins at zero") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const LogFit log(simulated({.n = 4000, .rate = 50, .white = 0.02, .seed = seed}), 50);
    const Result best = log.likelihood.maximise(white_and_walk);
    const auto interval = Profile(log.likelihood, white_and_walk, best).root(NoiseTerm::random_walk, 0.95);
    CHECK(interval.lower == 0);
    const double theta = interval.upper * interval.upper;
    const double excess =
        log.fit.maximise(white_and_walk, {}, Fit::Fixed{NoiseTerm::random_walk, theta}).objective - best.objective;
    // Bartlett's factor is between 1 and 4/3.
    CHECK(excess >= chi_square_quantile(0.95, 1.0) * 0.998);
    CHECK(excess <= chi_square_quantile(0.95, 1.0) * 4 / 3 * 1.002);
  }
}

TEST_CASE("Intervals scale with the signal, and times with the rate") {
  const auto y = biased();
  const LogFit log(y, 50);
  const Result best = log.likelihood.maximise(white_and_bias);
  const Profile profile(log.likelihood, white_and_bias, best);
  const auto white = profile.root(NoiseTerm::white, 0.95), bias = profile.gauss_markov_root(0.95);
  const auto time = profile.time(&Times::correlation, log.likelihood.correlation_times(), 0.95);
  const auto check = [](const Interval<double>& one, const Interval<double>& other, double factor) {
    CHECK_THAT(other.lower, WithinRel(one.lower * factor, 1e-4));
    CHECK_THAT(other.upper, WithinRel(one.upper * factor, 1e-4));
  };
  for (const double rate : {50.0, 2000.0}) {
    for (const double factor : {1e-6, 3.0, 1e6}) {
      INFO(factor << " times the signal at " << rate << " Hz");
      auto scaled = y;
      for (double& value : scaled) value *= factor;
      const LogFit other(scaled, rate);
      const Result found = other.likelihood.maximise(white_and_bias);
      const Profile same(other.likelihood, white_and_bias, found);
      // Roots are in the unit of the spectrum; √(θ·T) has √s besides.
      const double unit = factor * log.pooled.unit() / other.pooled.unit();
      check(white, same.root(NoiseTerm::white, 0.95), unit);
      check(bias, same.gauss_markov_root(0.95), unit * std::sqrt(50 / rate));
      check(time, same.time(&Times::correlation, other.likelihood.correlation_times(), 0.95), 50 / rate);
    }
  }
}
