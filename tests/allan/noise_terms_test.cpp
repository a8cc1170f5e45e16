// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <splinertia/allan/detail/model/spectral_fit.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/pi.hpp>
#include <string>

#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;

namespace {

using namespace splinertia::detail;

/// 4 ∫ S(f) sin⁴(πfτ)/(πfτ)² df, S the two-sided density of a term of coefficient 1: IEEE Std 952-1997, C.1. By
/// Simpson's rule in x = πfτ on [0, length], with the mean of sin⁴, 3/8, from there on.
double variance_of_density(NoiseTerm term, double tau) {
  const double pi = std::numbers::pi, length = 400 * pi;
  const auto density = [&](double f) {
    switch (term) {
      case NoiseTerm::random_walk:
        return 1 / (4 * pi * pi * f * f);
      case NoiseTerm::bias_instability:
        return 1 / (2 * pi * f);
      default:
        return 1.0;
    }
  };
  const auto integrand = [&](double x) {
    const double sine = std::sin(x);
    return x == 0 ? 0 : 4 * density(x / (pi * tau)) * sine * sine * (sine / x) * (sine / x) / (pi * tau);
  };
  constexpr int steps = 400'000;
  const double h = length / steps;
  double sum = integrand(h * 1e-6) + integrand(length);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * integrand(i * h);
  // ∫ x^(−2−p) = length^(−1−p)/(1 + p), p the power of 1/f of the density
  const int p = term == NoiseTerm::random_walk ? 2 : term == NoiseTerm::bias_instability ? 1 : 0;
  const double tail = 4 * density(length / (pi * tau)) / (pi * tau) * 3 / 8 / length / (1 + p);
  return sum * h / 3 + tail;
}

}  // namespace

TEST_CASE("The Allan variances of the noise terms are those of their densities") {
  for (const NoiseTerm term : {NoiseTerm::white, NoiseTerm::random_walk, NoiseTerm::bias_instability}) {
    for (const double tau : {0.01, 1.0, 300.0}) {
      INFO(symbol(term) << " at " << tau << " s");
      CHECK_THAT(allan_variance(term, tau), WithinRel(variance_of_density(term, tau), 1e-5));
    }
  }
}

TEST_CASE("The Allan variances of quantization and a ramp are those of second differences") {
  for (const double tau : {0.01, 1.0, 300.0}) {
    // Of independent errors with deviation Q of the integral, (1 + 4 + 1) Q²/(2τ²); of R t²/2, (R τ²)²/(2τ²).
    CHECK_THAT(allan_variance(NoiseTerm::quantization, tau), WithinRel(6 / (2 * tau * tau), 1e-14));
    CHECK_THAT(allan_variance(NoiseTerm::rate_ramp, tau), WithinRel(tau * tau / 2, 1e-14));
  }
}

TEMPLATE_TEST_CASE("Allan variances have the precision of the scalar", "", float, double, long double) {
  using Scalar = TestType;
  STATIC_CHECK(std::same_as<decltype(allan_variance(NoiseTerm::white, Scalar(1))), Scalar>);
  const Scalar third = Scalar(1) / 3, floor = 2 * static_cast<Scalar>(0.693147180559945309417232121458176568L) /
                                              splinertia::detail::pi_of<Scalar>();
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  CHECK(allan_variance(NoiseTerm::white, Scalar(3)) == third);
  CHECK(allan_variance(NoiseTerm::random_walk, Scalar(1)) == third);
  CHECK(allan_variance(NoiseTerm::quantization, Scalar(3)) == third);
  CHECK(allan_variance(NoiseTerm::rate_ramp, Scalar(3)) == Scalar(9) / 2);
  CHECK(std::abs(allan_variance(NoiseTerm::bias_instability, Scalar(7)) - floor) <= 2 * epsilon);
}

TEST_CASE("Noise terms have symbols and names") {
  STATIC_CHECK(symbol(NoiseTerm::white) == "N");
  STATIC_CHECK(symbol(NoiseTerm::random_walk) == "K");
  STATIC_CHECK(symbol(NoiseTerm::bias_instability) == "B");
  STATIC_CHECK(symbol(NoiseTerm::quantization) == "Q");
  STATIC_CHECK(symbol(NoiseTerm::rate_ramp) == "R");
  std::set<std::string> names;
  for (std::size_t i = 0; i < noise_terms.size(); ++i) {
    CHECK(static_cast<std::size_t>(noise_terms[i]) == i);
    names.insert(std::string(name(noise_terms[i])));
  }
  CHECK(names.size() == 7);
  STATIC_CHECK(name(NoiseTerm::random_walk) == "random walk");
}

TEST_CASE("Sets of noise terms") {
  constexpr NoiseTerms both{NoiseTerm::white, NoiseTerm::rate_ramp};
  STATIC_CHECK(both.has(NoiseTerm::white));
  STATIC_CHECK(both.has(NoiseTerm::rate_ramp));
  STATIC_CHECK_FALSE(both.has(NoiseTerm::random_walk));
  STATIC_CHECK(both.without(NoiseTerm::rate_ramp) == NoiseTerms{NoiseTerm::white});
  STATIC_CHECK(both.without(NoiseTerm::quantization) == both);
  STATIC_CHECK(NoiseTerms{NoiseTerm::white}.with(NoiseTerm::rate_ramp) == both);
  STATIC_CHECK(both.with(NoiseTerm::white) == both);
  STATIC_CHECK(both.within(NoiseTerms::all()));
  STATIC_CHECK_FALSE(NoiseTerms::all().within(both));
  STATIC_CHECK(NoiseTerms().empty());
  STATIC_CHECK(NoiseTerms().within(NoiseTerms()));
  for (unsigned number = 0; number < NoiseTerms::sets; ++number) {
    NoiseTerms set;
    for (const NoiseTerm term : noise_terms) {
      if (NoiseTerms::numbered(number).has(term)) set = set.with(term);
    }
    CHECK(set.number() == number);
  }
}

TEST_CASE("Estimates by term, and the deviation that the best description adds up to") {
  NoiseEstimates<double> estimates;
  CHECK(estimates.deviation(2.0) == 0);
  const std::array<double, 7> values{1, 2, 3, 4, 5, 6, 7};
  for (const NoiseTerm term : noise_terms) {
    Estimate<double>& estimate = estimates[term];
    CHECK(estimate.value == 0);
    CHECK_FALSE(estimate.detected);
    CHECK_FALSE(estimate.possible);
    estimate.value = values[static_cast<std::size_t>(term)];
    estimate.one_sigma = {estimate.value - 0.5, estimate.value + 1};
    CHECK(estimate.standard_error() == 0.75);
  }
  const auto& same = estimates;
  CHECK(&same[NoiseTerm::white] == &estimates.N);
  CHECK(&same[NoiseTerm::random_walk] == &estimates.K);
  CHECK(&same[NoiseTerm::bias_instability] == &estimates.B);
  CHECK(&same[NoiseTerm::quantization] == &estimates.Q);
  CHECK(&same[NoiseTerm::rate_ramp] == &estimates.R);
  CHECK(&same[NoiseTerm::gauss_markov] == &estimates.G);
  CHECK(&same[NoiseTerm::warm_up] == &estimates.W);
  CHECK(estimates.deviation(2.0) == 0);
  estimates.duration = 50;
  estimates.descriptions.push_back({.terms = NoiseTerms::all(), .values = {1, 0, 0, 0, 5}});
  CHECK_THAT(estimates.deviation(2.0), WithinRel(std::sqrt(1.0 / 2 + 25.0 * 4 / 2), 1e-14));
  estimates.descriptions.front() = {
      .terms = NoiseTerms::all(), .values = values, .correlation_time = 3, .decay_time = 11};
  const double floor = 2 * std::numbers::ln2 / std::numbers::pi;
  CHECK_THAT(estimates.deviation(2.0), WithinRel(std::sqrt(1.0 / 2 + 4.0 * 2 / 3 + 9 * floor + 16.0 * 3 / 4 +
                                                           25.0 * 4 / 2 + 36 * gauss_markov_allan_variance(2.0, 3.0) +
                                                           49 * warm_up_allan_variance(2.0, 11.0, 50.0)),
                                                 1e-14));
}

TEST_CASE("The Allan variance of a Gauss-Markov bias is that of its covariance") {
  const double time = 7;
  for (const double tau : {1e-6, 0.01, 0.0699, 0.0701, 0.5, 7.0, 60.0, 1e4, 1e9}) {
    INFO("tau " << tau);
    // Half the variance of the difference of neighbouring averages: γ(0..τ) twice, less the covariance across.
    const long double x = static_cast<long double>(tau) / time;
    const long double within = 2 / x * (1 + std::expm1(-x) / x);         // of one average
    const long double across = std::expm1(-x) * std::expm1(-x) / x / x;  // of two neighbours
    const double exact = static_cast<double>(within - across);
    // The difference cancels for small x: there the limit is a random walk's K²τ/3 with K² = 2/T.
    const double reference = x < 1e-3L ? 2 * tau / (3 * time) : exact;
    CHECK_THAT(gauss_markov_allan_variance(tau, time), WithinRel(reference, x < 1e-3L ? 1e-3 : 1e-4));
  }
  CHECK_THAT(
      gauss_markov_allan_variance(60.0, 7.0),
      WithinRel(2 / (60.0 / 7) * (1 - (3 - 4 * std::exp(-60.0 / 7) + std::exp(-120.0 / 7)) / (120.0 / 7)), 1e-13));
}

TEST_CASE("The Allan variance of a warm-up is that of its averages over the log") {
  const double decay = 20, duration = 100;
  constexpr int n = 100'000;
  for (const double tau : {0.1, 5.0, 20.0, 49.0}) {
    INFO("tau " << tau);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double start = (duration - 2 * tau) * (i + 0.5) / n;
      const auto mean = [&](double from) { return decay / tau * std::exp(-from / decay) * -std::expm1(-tau / decay); };
      const double difference = mean(start + tau) - mean(start);
      sum += difference * difference / (2.0 * n);
    }
    CHECK_THAT(warm_up_allan_variance(tau, decay, duration), WithinRel(sum, 1e-6));
  }
  // At most one place: the beginning.
  CHECK_THAT(warm_up_allan_variance(50.0, decay, duration),
             WithinRel(std::pow(decay / 50 * std::pow(std::expm1(-2.5), 2), 2) / 2, 1e-12));
}
