// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <splinertia/allan/fit_curve.hpp>
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

/// Points without noise of coefficients in the order of standard_terms, an octave apart, as of a log of 2¹⁸ samples.
template <typename Scalar>
DeviationCurve<Scalar> model_curve(const std::vector<Scalar>& coefficients, Scalar rate) {
  constexpr std::int64_t n = 1 << 18;
  DeviationCurve<Scalar> curve{"oadev", rate, n, 0, one_sigma<Scalar>, {}};
  for (const std::int64_t m : AveragingFactors::octave().up_to(n / 4)) {
    const Scalar tau = static_cast<Scalar>(m) / rate;
    Scalar variance = 0;
    for (const NoiseTerm term : standard_terms) {
      const Scalar& coefficient = coefficients[static_cast<std::size_t>(term)];
      variance += coefficient * coefficient * allan_variance(term, tau);
    }
    curve.points.push_back({m, tau, n - 2 * m, std::sqrt(variance), 0, Scalar(n) / static_cast<Scalar>(m), {}});
  }
  return curve;
}

bool sound(const NoiseEstimates<double>& estimates) {
  bool good = true;
  for (const NoiseTerm term : standard_terms) {
    const auto& estimate = estimates[term];
    for (const auto& interval : {estimate.interval, estimate.one_sigma}) {
      good = good && interval.lower >= 0 && interval.upper >= interval.lower && !std::isnan(interval.upper);
    }
    good = good && estimate.value >= 0 && std::isfinite(estimate.value);
  }
  return good;
}

}  // namespace

TEMPLATE_TEST_CASE("The coefficients of a curve without noise", "", double, long double) {
  using Scalar = TestType;
  // Each term rules somewhere between 5 ms and 164 s.
  const std::vector<std::vector<Scalar>> models{{Scalar(0.02L), 0, 0, 0, 0},
                                                {Scalar(0.02L), Scalar(0.002L), 0, 0, 0},
                                                {Scalar(0.02L), 0, Scalar(0.02L), 0, 0},
                                                {Scalar(0.02L), 0, 0, Scalar(0.002L), 0},
                                                {Scalar(0.02L), 0, 0, 0, Scalar(0.0003L)},
                                                {Scalar(0.02L), Scalar(0.01L), Scalar(0.04L), Scalar(0.002L), 0}};
  for (std::size_t k = 0; k < models.size(); ++k) {
    const auto curve = model_curve(models[k], Scalar(200));
    const auto estimates = fit_curve(curve);
    for (const NoiseTerm term : standard_terms) {
      INFO("model " << k << ", " << symbol(term));
      const auto& estimate = estimates[term];
      const Scalar truth = models[k][static_cast<std::size_t>(term)];
      CHECK(estimate.detected == (truth > 0));
      if (truth > 0) {
        CHECK(std::abs(estimate.value / truth - 1) < Scalar(1e-6L));
        CHECK(estimate.interval.lower < truth);
        CHECK(estimate.interval.upper > truth);
        CHECK(estimate.one_sigma.lower > estimate.interval.lower);
        CHECK(estimate.one_sigma.upper < estimate.interval.upper);
      } else {
        CHECK(estimate.interval.lower == 0);
        CHECK(estimate.interval.upper > 0);
      }
    }
    CHECK(estimates.highest_frequency == 100);
    CHECK(estimates.bands.empty());
    for (const auto& point : curve.points) {
      CHECK(std::abs(estimates.deviation(point.tau) / point.deviation - 1) < Scalar(1e-6L));
    }
  }
}

TEST_CASE("The standard errors of a curve's fit are those of simulated logs") {
  constexpr int logs = 100;
  const double truth[] = {0.02, 0.03};
  double sums[2] = {}, squares[2] = {}, errors[2] = {};
  int within[2] = {}, detected = 0;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const auto y = simulated({.n = 8000, .rate = 50, .white = truth[0], .walk = truth[1], .seed = seed});
    for (const bool separate : {false, true}) {
      if (separate && seed > 5) continue;
      const DeviationOptions<double> options{.phase_model = PhaseModel::sampled};
      const auto curve =
          separate ? splinertia::allan::curve<AllanDeviation>(y, 50, options) : overlapping(y, 50, options);
      const auto estimates = fit_curve(curve, {NoiseTerm::white, NoiseTerm::random_walk});
      CHECK_THAT(estimates.N.value, WithinRel(truth[0], 0.1));
      CHECK_THAT(estimates.K.value, WithinRel(truth[1], 0.7));
      if (separate) continue;
      detected += estimates.K.detected ? 1 : 0;
      for (int j = 0; j < 2; ++j) {
        const auto& estimate = estimates[standard_terms[static_cast<std::size_t>(j)]];
        sums[j] += estimate.value / logs;
        squares[j] += estimate.value * estimate.value / logs;
        errors[j] += estimate.standard_error() / logs;
        within[j] += estimate.interval.lower <= truth[j] && truth[j] <= estimate.interval.upper ? 1 : 0;
      }
    }
  }
  CHECK(detected >= 95);
  for (int j = 0; j < 2; ++j) {
    INFO((j == 0 ? "N" : "K"));
    const double scatter = std::sqrt(squares[j] - sums[j] * sums[j]);
    CHECK_THAT(errors[j], WithinRel(scatter, 0.3));
    CHECK_THAT(sums[j], WithinAbs(truth[j], 5 * scatter / 10 + 0.03 * truth[j]));
    CHECK(within[j] >= 84);  // 95, less five standard deviations
  }
}

TEST_CASE("Terms that a curve does not have are seldom found in it") {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto estimates = fit_curve(overlapping(simulated({.n = 4000, .rate = 50, .white = 0.02, .seed = seed}), 50));
    CHECK(estimates.N.detected);
    CHECK_THAT(estimates.N.value, WithinRel(0.02, 0.1));
    for (const NoiseTerm term : standard_terms) {
      if (term == NoiseTerm::white) continue;
      found += estimates[term].detected ? 1 : 0;
      CHECK(estimates[term].interval.upper > 0);
    }
  }
  CHECK(found <= 12);
}

TEST_CASE("A curve's candidates") {
  const auto curve = model_curve<double>({0.02, 0.002, 0, 0, 0}, 200.0);
  const auto estimates = fit_curve(curve, {NoiseTerm::white, NoiseTerm::random_walk, NoiseTerm::quantization});
  CHECK(estimates.N.detected);
  CHECK(estimates.K.detected);
  CHECK(estimates.B.interval.upper == 0);
  CHECK(estimates.R.interval.upper == 0);
  CHECK(estimates.Q.interval.upper > 0);
  const auto walk = fit_curve(curve, {NoiseTerm::random_walk});
  CHECK(walk.K.detected);
  CHECK_FALSE(walk.N.detected);
  const auto ramp = fit_curve(model_curve<double>({0, 0, 0, 0, 0.1}, 200.0), {NoiseTerm::rate_ramp});
  CHECK_THAT(ramp.R.value, WithinRel(0.1, 1e-9));
  const auto wide = fit_curve(curve, NoiseTerms::all(), 0.999);
  CHECK(wide.K.interval.lower < estimates.K.interval.lower);
  CHECK(wide.K.interval.upper > estimates.K.interval.upper);
}

TEST_CASE("A curve's coefficients scale with its unit") {
  auto curve = model_curve<double>({0.02, 0.002, 0, 0.001, 0}, 200.0);
  const auto estimates = fit_curve(curve);
  for (const double factor : {1e-250, 1e250}) {
    auto scaled = curve;
    for (auto& point : scaled.points) point.deviation *= factor;
    const auto other = fit_curve(scaled);
    for (const NoiseTerm term : standard_terms) {
      CHECK(other[term].detected == estimates[term].detected);
      CHECK_THAT(other[term].interval.upper, WithinRel(estimates[term].interval.upper * factor, 1e-6));
    }
  }
}

TEST_CASE("Curves of short and strange signals have sound fits") {
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal;
  for (const std::size_t n : {5U, 6U, 8U, 12U, 20U, 50U, 200U}) {
    for (int kind = 0; kind < 8; ++kind) {
      std::vector<double> y(n);
      double walk = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const double x = normal(bits), t = static_cast<double>(i);
        walk += x;
        const double values[] = {x, walk, t, i % 2 == 0 ? 1.0 : -1.0, std::round(x), t * t, 1e300 * x, 1e-300 * x};
        y[i] = values[kind];
      }
      INFO(n << " samples of kind " << kind);
      for (const unsigned set : {31U, 3U, 4U, 16U, 24U}) {
        CHECK(sound(fit_curve(overlapping(y, 200.0), NoiseTerms::numbered(set))));
      }
    }
  }
}

TEST_CASE("Curves that cannot be fitted are refused") {
  const auto good = model_curve<double>({0.02, 0.002, 0, 0, 0}, 200.0);
  const auto refusal = [&](const auto& change) {
    auto curve = good;
    change(curve);
    return message_of([&] { return fit_curve(curve); });
  };
  CHECK(refusal([](auto&) {}) == "nothing thrown");
  CHECK(refusal([](auto& curve) { curve.name = "adev"; }) == "nothing thrown");
  CHECK(refusal([](auto& curve) { curve.name = "mdev"; }) ==
        "fit_curve: the curve's name is mdev, expected adev or oadev");
  CHECK(refusal([](auto& curve) { curve.name = "ohdev"; }) ==
        "fit_curve: the curve's name is ohdev, expected adev or oadev");
  CHECK(refusal([](auto& curve) { curve.points.resize(1); }) ==
        "fit_curve: 1 points, expected at least 2, and a deviation above zero");
  CHECK(refusal([](auto& curve) {
          for (auto& point : curve.points) point.deviation = 0;
        }).ends_with("expected at least 2, and a deviation above zero"));
  CHECK(refusal([](auto& curve) { curve.rate = 0; }) == "fit_curve: rate is 0, expected a finite number > 0");
  CHECK(refusal([](auto& curve) { curve.points[3].tau = 0; }) == "fit_curve: tau is 0, expected a finite number > 0");
  CHECK(refusal([](auto& curve) { curve.points[3].deviation = -1; }) ==
        "fit_curve: deviation is -1, expected a finite number >= 0");
  CHECK(refusal([](auto& curve) { curve.points[3].deviation = std::numeric_limits<double>::quiet_NaN(); }) ==
        "fit_curve: deviation is nan, expected a finite number >= 0");
  CHECK(refusal([](auto& curve) { curve.points[3].degrees_of_freedom = 0; }) ==
        "fit_curve: degrees of freedom is 0, expected a finite number > 0");
  CHECK(message_of([&] { return fit_curve(good, {}); }) == "fit_curve: no candidates, expected a noise term");
  CHECK(message_of([&] { return fit_curve(good, NoiseTerms::all(), 1.0); }) ==
        "fit_curve: confidence is 1, expected a number between 0 and 1");
}

TEST_CASE("The order of a curve's points does not matter") {
  auto curve = model_curve<double>({0.02, 0.002, 0, 0, 0}, 200.0);
  const auto estimates = fit_curve(curve);
  std::reverse(curve.points.begin(), curve.points.end());
  const auto reversed = fit_curve(curve);
  for (const NoiseTerm term : standard_terms) {
    CHECK_THAT(reversed[term].interval.upper, WithinRel(estimates[term].interval.upper, 1e-6));
  }
}
