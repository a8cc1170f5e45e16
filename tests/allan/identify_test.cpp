// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <random>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/identify.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "allan/simulated.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

using Estimates = NoiseEstimates<double>;
constexpr NoiseTerms white_and_walk{NoiseTerm::white, NoiseTerm::random_walk};

Estimates identified(const SimulatedNoise& noise, const IdentifyOptions<double>& options = {}) {
  return identify(simulated(noise), noise.rate, options);
}

/// Within five standard errors: by chance once in two million.
void check_recovered(const Estimate<double>& estimate, double truth) {
  CHECK(estimate.detected);
  CHECK(estimate.standard_error() > 0);
  CHECK_THAT(estimate.value, WithinAbs(truth, 5 * estimate.standard_error()));
  CHECK(estimate.one_sigma.lower > estimate.interval.lower);
  CHECK(estimate.one_sigma.upper < estimate.interval.upper);
  CHECK(estimate.value > estimate.one_sigma.lower);
  CHECK(estimate.value < estimate.one_sigma.upper);
}

void check_limit(const Estimate<double>& estimate, double limit) {
  CHECK_FALSE(estimate.detected);
  CHECK(estimate.interval.lower == 0);
  CHECK(estimate.one_sigma.lower == 0);
  CHECK(estimate.interval.upper > 0);
  CHECK(estimate.one_sigma.upper <= estimate.interval.upper);
  CHECK(estimate.interval.upper < limit);
}

/// Numbers, in the order that they must have.
bool sound(const Estimates& estimates) {
  bool good = std::isfinite(estimates.highest_frequency) && !estimates.bands.empty();
  for (const NoiseTerm term : noise_terms) {
    const auto& estimate = estimates[term];
    for (const auto& interval : {estimate.interval, estimate.one_sigma}) {
      good = good && interval.lower >= 0 && interval.upper >= interval.lower && std::isfinite(interval.upper);
    }
    good = good && estimate.value >= 0 && std::isfinite(estimate.value);
  }
  for (const auto& band : estimates.bands) {
    good = good && std::isfinite(band.ratio) && band.ratio >= 0 && std::isfinite(band.standard_error) &&
           band.frequencies.lower <= band.frequencies.upper;
  }
  return good;
}

/// Each estimate of `a` times what belongs to it is that of `b`.
using Factors = std::array<double, noise_terms.size()>;

/// One factor for all terms.
Factors alike(double factor) {
  Factors factors;
  factors.fill(factor);
  return factors;
}

void check_scaled(const Estimates& a, const Estimates& b, const Factors& factors, double tolerance) {
  for (const NoiseTerm term : noise_terms) {
    INFO(symbol(term));
    const double factor = factors[static_cast<std::size_t>(term)];
    const double slack = tolerance * a[term].interval.upper * factor;
    CHECK(a[term].detected == b[term].detected);
    CHECK_THAT(b[term].value, WithinAbs(a[term].value * factor, slack));
    CHECK_THAT(b[term].interval.lower, WithinAbs(a[term].interval.lower * factor, slack));
    CHECK_THAT(b[term].interval.upper, WithinAbs(a[term].interval.upper * factor, slack));
    CHECK_THAT(b[term].one_sigma.upper, WithinAbs(a[term].one_sigma.upper * factor, slack));
  }
}

}  // namespace

TEST_CASE("White noise and random walk of a log") {
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto estimates = identified({.n = 200'000, .rate = 50, .white = 0.02, .walk = 1e-3, .seed = seed});
    check_recovered(estimates.N, 0.02);
    check_recovered(estimates.K, 1e-3);
    CHECK(estimates.N.standard_error() < 0.02 * 2e-3);
    CHECK(estimates.K.standard_error() < 1e-3 * 0.15);
    check_limit(estimates.B, 0.01);
    check_limit(estimates.Q, 3e-4);
    check_limit(estimates.R, 1e-4);
    CHECK(estimates.fits);
    CHECK(estimates.highest_frequency == 25);
    CHECK(estimates.bands.front().frequencies.upper <= 25);
    CHECK(estimates.bands.front().frequencies.upper > 24.9);
  }
}

TEST_CASE("Bias instability of a log") {
  const auto estimates = identified({.n = 200'000, .rate = 50, .white = 0.02, .flicker = 0.015, .seed = 1});
  check_recovered(estimates.N, 0.02);
  check_recovered(estimates.B, 0.015);
  check_limit(estimates.Q, 3e-4);
  check_limit(estimates.R, 1e-4);
  CHECK_FALSE(estimates.K.detected);
}

TEST_CASE("Quantization noise of a log") {
  const auto estimates = identified({.n = 100'000, .rate = 50, .white = 0.02, .quantization = 1e-3, .seed = 1});
  check_recovered(estimates.N, 0.02);
  check_recovered(estimates.Q, 1e-3);
  check_limit(estimates.K, 3e-4);
}

TEST_CASE("Ramps, up and down") {
  for (const double ramp : {3e-4, -3e-4}) {
    const auto estimates = identified({.n = 100'000, .rate = 50, .white = 0.02, .walk = 1e-4, .ramp = ramp, .seed = 1});
    check_recovered(estimates.N, 0.02);
    check_recovered(estimates.R, 3e-4);
    CHECK(estimates.K.interval.upper < 1e-3);
  }
}

TEST_CASE("Walk alone") {
  const auto estimates = identified({.n = 20'000, .rate = 50, .walk = 0.3, .seed = 1});
  check_recovered(estimates.K, 0.3);
  check_limit(estimates.N, 1e-2);
}

TEST_CASE("A walk that is not in the log has a limit") {
  // About 10 N/duration; a walk of which the whole log has a hundredth of the white noise of a second is below it.
  for (const double walk : {0.0, 1e-7}) {
    const auto estimates = identified({.n = 100'000, .rate = 50, .white = 0.02, .walk = walk, .seed = 2});
    check_recovered(estimates.N, 0.02);
    check_limit(estimates.K, 20 * 0.02 / 2000);
    CHECK(estimates.K.interval.upper > 0.02 / 2000);
  }
}

TEST_CASE("The curve of what is identified goes through that of the signal") {
  const SimulatedNoise noise{.n = 100'000, .rate = 50, .white = 0.02, .walk = 2e-3, .seed = 4};
  const auto y = simulated(noise);
  const auto estimates = identify(y, 50);
  for (const auto& point : overlapping(y, 50, {.confidence = 0.9999}).points) {
    if (point.tau > 200) break;
    INFO("at " << point.tau << " s");
    CHECK(estimates.deviation(point.tau) > point.interval.lower);
    CHECK(estimates.deviation(point.tau) < point.interval.upper);
  }
}

TEST_CASE("Only candidates are identified") {
  const SimulatedNoise noise{.n = 20'000, .rate = 50, .white = 0.02, .walk = 5e-3, .seed = 5};
  const auto both = identified(noise, {.candidates = white_and_walk});
  check_recovered(both.N, 0.02);
  check_recovered(both.K, 5e-3);
  const auto white = identified(noise, {.candidates = {NoiseTerm::white}});
  CHECK(white.N.detected);
  for (const auto& estimates : {both, white}) {
    for (const NoiseTerm term : noise_terms) {
      if (white_and_walk.has(term)) continue;
      CHECK_FALSE(estimates[term].detected);
      CHECK(estimates[term].value == 0);
      CHECK(estimates[term].interval.upper == 0);
    }
  }
  CHECK(white.K.interval.upper == 0);
}

TEST_CASE("The confidence of the intervals") {
  const SimulatedNoise noise{.n = 20'000, .rate = 50, .white = 0.02, .walk = 5e-3, .seed = 6};
  const auto one = identified(noise, {.confidence = one_sigma<double>, .candidates = white_and_walk});
  const auto more = identified(noise, {.confidence = 0.999, .candidates = white_and_walk});
  for (const NoiseTerm term : {NoiseTerm::white, NoiseTerm::random_walk}) {
    CHECK_THAT(one[term].interval.lower, WithinRel(one[term].one_sigma.lower, 1e-5));
    CHECK_THAT(one[term].interval.upper, WithinRel(one[term].one_sigma.upper, 1e-5));
    CHECK(more[term].interval.lower < one[term].interval.lower);
    CHECK(more[term].interval.upper > one[term].interval.upper);
    CHECK(more[term].value == one[term].value);
  }
  // Of many squares, the error of √θ is all but normal.
  CHECK_THAT(more.N.interval.upper - more.N.interval.lower, WithinRel(3.2905 * 2 * one.N.standard_error(), 0.01));
}

TEST_CASE("A low-pass filter is left out") {
  auto y = simulated({.n = 100'000, .rate = 50, .white = 0.02, .walk = 1e-3, .seed = 7});
  auto averaged = y, first_order = y;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (i >= 5) averaged[i] = (y[i] + y[i - 1] + y[i - 2] + y[i - 3] + y[i - 4]) / 5;
    if (i > 0) first_order[i] = first_order[i - 1] + 0.6 * (y[i] - first_order[i - 1]);
  }
  for (const auto& filtered : {averaged, first_order}) {
    const auto estimates = identify(filtered, 50);
    CHECK(estimates.fits);
    CHECK(estimates.highest_frequency < 25);
    CHECK(estimates.highest_frequency > 0.3);
    // What is left of the filter in the octaves that chance could have made: more than N's standard error.
    CHECK_THAT(estimates.N.value, WithinRel(0.02, 0.03));
    CHECK_THAT(estimates.K.value, WithinAbs(1e-3, 5 * estimates.K.standard_error()));
    CHECK(estimates.K.detected);
    // Asked for all frequencies, it says that they do not fit.
    const auto all = identify(filtered, 50, {.exclude_misfits = false});
    CHECK_FALSE(all.fits);
    CHECK(all.highest_frequency == 25);
  }
}

TEST_CASE("The highest frequency can be given") {
  const SimulatedNoise noise{.n = 20'000, .rate = 50, .white = 0.02, .seed = 8};
  const auto part = identified(noise, {.candidates = {NoiseTerm::white}, .highest_frequency = 5});
  CHECK(part.highest_frequency == 5);
  CHECK(part.bands.front().frequencies.upper <= 5);
  check_recovered(part.N, 0.02);
  const auto all = identified(noise, {.candidates = {NoiseTerm::white}});
  CHECK_THAT(part.N.standard_error(), WithinRel(all.N.standard_error() * std::sqrt(5.0), 0.02));
  const auto beyond = identified(noise, {.candidates = {NoiseTerm::white}, .highest_frequency = 1e9});
  CHECK(beyond.highest_frequency == 25);
  CHECK(beyond.N.value == all.N.value);
}

TEST_CASE("Three axes that are alike have errors smaller by the root of three") {
  const auto y = simulated({.n = 20'000, .rate = 50, .white = 0.02, .walk = 5e-3, .ramp = 5e-3, .seed = 9});
  const IntegratedSignal<double> signal(y, 50);
  const DifferenceSpectrum<double> spectrum(signal);
  // The same three times: that chance deviates alike in all of them is not what chance does.
  const IdentifyOptions<double> options{.exclude_misfits = false};
  const auto single = identify(signal, options), same = identify_pooled<double>({spectrum}, options);
  check_scaled(single, same, alike(1), 0);
  const auto pooled = identify_pooled<double>({spectrum, spectrum, spectrum}, options);
  for (const NoiseTerm term : {NoiseTerm::white, NoiseTerm::random_walk, NoiseTerm::rate_ramp}) {
    INFO(symbol(term));
    CHECK((pooled[term].detected || pooled[term].possible));
    CHECK_THAT(pooled[term].value, WithinAbs(single[term].value, single[term].standard_error() / 10));
    const double half = (pooled[term].one_sigma.upper - pooled[term].value) * std::sqrt(3.0);
    // That of a walk is over all descriptions that pay for themselves, which are others.
    const double tolerance = term == NoiseTerm::random_walk ? 0.25 : 0.05;
    CHECK_THAT(half, WithinRel(single[term].one_sigma.upper - single[term].value, tolerance));
  }
  auto turned = y;
  for (double& value : turned) value = 9.81 - value;
  const DifferenceSpectrum<double> other{IntegratedSignal<double>(turned, 50)};
  CHECK_THAT(identify_pooled<double>({spectrum, other}).R.value, WithinRel(single.R.value, 0.1));
}

TEST_CASE("Results scale with the signal and the rate") {
  const auto y = simulated({.n = 3000, .rate = 1, .white = 1, .walk = 0.05, .ramp = 2e-3, .seed = 10});
  const auto estimates = identify(y, 1.0);
  CHECK(estimates.K.detected);
  // By powers of two: the same numbers, but for their exponents.
  for (const double factor : {0x1p-660, 0x1p660, -1.0}) {
    auto scaled = y;
    for (double& value : scaled) value *= factor;
    check_scaled(estimates, identify(scaled, 1.0), alike(std::abs(factor)), 1e-14);
  }
  for (const double factor : {1e-200, 1e-3, 1e200}) {
    auto scaled = y;
    for (double& value : scaled) value *= factor;
    check_scaled(estimates, identify(scaled, 1.0), alike(factor), 1e-5);
  }
  const double root = std::sqrt(1000.0);
  // Ends of intervals are found to 1e-5 of their distance.
  check_scaled(estimates, identify(y, 1000.0), {1 / root, root, 1, 1e-3, 1e3, 1, 1}, 1e-6);
}

TEST_CASE("The mean of the signal does not matter") {
  auto y = simulated({.n = 3000, .rate = 1, .white = 1, .walk = 0.05, .seed = 11});
  for (double& value : y) value = std::round(value * 0x1p20) * 0x1p-20;
  const auto estimates = identify(y, 1.0);
  for (const double mean : {-3.0, 9.81, 1e6}) {
    auto moved = y;
    for (double& value : moved) value += mean;
    check_scaled(estimates, identify(moved, 1.0), alike(1), 1e-5);
  }
}

TEST_CASE("Other signals and scalars have the same estimates") {
  const auto y = simulated({.n = 3000, .rate = 50, .white = 1, .walk = 0.3, .seed = 12});
  const auto estimates = identify(y, 50);
  const std::vector<long double> wide(y.begin(), y.end());
  const auto more = identify(wide, 50);
  STATIC_CHECK(std::same_as<decltype(more), const NoiseEstimates<long double>>);
  for (const NoiseTerm term : noise_terms) {
    const auto& estimate = estimates[term];
    const auto& precise = more[term];
    CHECK(estimate.detected == precise.detected);
    CHECK_THAT(estimate.interval.upper, WithinRel(static_cast<double>(precise.interval.upper), 1e-4));
    CHECK_THAT(estimate.interval.lower, WithinRel(static_cast<double>(precise.interval.lower), 1e-4));
  }
  const std::vector<float> narrow(y.begin(), y.end());
  CHECK_THAT(identify(narrow, 50).N.value, WithinRel(estimates.N.value, 1e-4));
  std::vector<double> angles{0};
  for (const double value : y) angles.push_back(angles.back() + value / 50);
  const auto integral = identify(IntegratedSignal<double>::from_integral(angles, 50));
  CHECK_THAT(integral.N.value, WithinRel(estimates.N.value, 1e-5));
  CHECK_THAT(integral.K.value, WithinRel(estimates.K.value, 1e-4));
}

TEST_CASE("Short logs and strange signals have sound estimates") {
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal;
  for (std::size_t n = 3; n <= 60; n = n < 22 ? n + 1 : 60 * n / 22) {
    for (int kind = 0; kind < 14; ++kind) {
      std::vector<double> y(n);
      double walk = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const double x = normal(bits), t = static_cast<double>(i);
        walk += x;
        const double values[] = {x,
                                 walk,
                                 t,
                                 t + 1e-9 * x,
                                 std::round(x),
                                 std::round(x / 10) + (i == 0 ? 1 : 0),
                                 i == n / 2 ? 1.0 : 0.0,
                                 i % 2 == 0 ? 1.0 : -1.0,
                                 t * t,
                                 std::sin(0.7 * t),
                                 i == n - 1 ? 1.0 : 9.81,
                                 1e300 * x,
                                 1e-300 * x,
                                 1e12 + t};
        y[i] = values[kind];
      }
      INFO(n << " samples of kind " << kind);
      CHECK(sound(identify(y, 200)));
    }
  }
}

TEST_CASE("Longer strange signals, too") {
  std::vector<double> ramp, steps, end(1100, 0.1), hum;
  const auto y = simulated({.n = 1100, .white = 1, .walk = 0.1, .seed = 13});
  for (std::size_t i = 0; i < y.size(); ++i) {
    ramp.push_back(static_cast<double>(i));
    steps.push_back(std::round(y[i] / 3));
    hum.push_back(std::sin(0.9 * static_cast<double>(i)) + 1e-6 * y[i]);
  }
  end.back() = 1;  // beyond the length of the transform
  for (const auto& signal : {ramp, steps, end, hum}) CHECK(sound(identify(signal, 200)));
  const auto estimates = identify(ramp, 200);
  CHECK_THAT(estimates.R.value, WithinRel(200.0, 1e-12));
  CHECK(estimates.R.possible);  // what rounding leaves is no noise that these terms describe
  CHECK(estimates.N.interval.upper < 1e-4);
}

TEST_CASE("Logs and options that cannot be are refused") {
  const auto y = simulated({.n = 400, .white = 1, .seed = 14});
  const auto refusal = [&](const IdentifyOptions<double>& options) {
    return message_of([&] { return identify(y, 200.0, options); });
  };
  CHECK(refusal({.confidence = 0}) == "identify: confidence is 0, expected a number between 0 and 1");
  CHECK(refusal({.confidence = 1}) == "identify: confidence is 1, expected a number between 0 and 1");
  CHECK(refusal({.confidence = std::numeric_limits<double>::quiet_NaN()}) ==
        "identify: confidence is nan, expected a number between 0 and 1");
  CHECK(refusal({.candidates = {}}) ==
        "identify: candidates, expected at least one of white noise, random walk, bias instability and quantization "
        "noise");
  CHECK(refusal({.candidates = {NoiseTerm::rate_ramp}}) ==
        "identify: candidates, expected at least one of white noise, random walk, bias instability and quantization "
        "noise");
  CHECK(refusal({.highest_frequency = -1}) == "identify: highest_frequency is -1, expected a finite number >= 0");
  CHECK(refusal({.highest_frequency = std::numeric_limits<double>::infinity()}) ==
        "identify: highest_frequency is inf, expected a finite number >= 0");
  CHECK(refusal({.highest_frequency = 2}) ==
        "identify: highest_frequency is 2 Hz, expected more than eight times the lowest frequency of the spectrum, "
        "0.25 Hz");
  CHECK(refusal({.highest_frequency = 2.1}) == "nothing thrown");
  CHECK(message_of([&] { return identify(y, 0.0); }) == "Allan analysis: rate is 0, expected a finite number > 0");
  CHECK(message_of([&] { return identify(std::vector<double>{1, 2}, 1.0); }) ==
        "Allan analysis: 2 values, expected at least 3");
  CHECK_THROWS_AS(identify(std::vector<double>(9, 1.5), 1.0), std::invalid_argument);
}

TEST_CASE("Axes that do not belong together are refused") {
  const auto y = simulated({.n = 400, .white = 1, .seed = 14});
  const auto spectrum = [](const std::vector<double>& signal, double rate) {
    return DifferenceSpectrum<double>(IntegratedSignal<double>(signal, rate));
  };
  CHECK(message_of([] { return identify_pooled<double>({}); }) == "identify_pooled: no axes");
  CHECK(message_of([&] { return identify_pooled<double>({spectrum(y, 200), spectrum(y, 100)}); }) ==
        "identify_pooled: an axis has 400 samples at 100 Hz, expected 400 at 200 Hz");
  CHECK(message_of([&] {
          return identify_pooled<double>({spectrum(y, 200), spectrum({y.begin() + 1, y.end()}, 200)});
        }) == "identify_pooled: an axis has 399 samples at 200 Hz, expected 400 at 200 Hz");
}
