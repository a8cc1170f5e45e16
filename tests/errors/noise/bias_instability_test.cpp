// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <splinertia/errors/noise/bias_instability.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;
using std::numbers::pi;

namespace {

// A stationary Gauss–Markov process.
struct Process {
  double variance, tau;

  // Of averages over a time T in continuous time: 2σ²/x (1 − (3 − 4e^−x + e^−2x)/(2x)), x = T/τ, or its series.
  [[nodiscard]] double allan_variance(double T) const {
    const double x = T / tau;
    if (x < 1e-3) return variance * (2 * x / 3 - x * x / 2 + 7 * x * x * x / 30);
    return variance * 2 / x * (1 - (3 - 4 * std::exp(-x) + std::exp(-2 * x)) / (2 * x));
  }
  // Two-sided, at f.
  [[nodiscard]] double density(double f) const { return 2 * variance * tau / (1 + std::pow(2 * pi * f * tau, 2)); }

  // Autocovariance of the differences of neighbouring averages over m samples at intervals of h τ. The averages have
  // variance (m(1 − φ²) − 2φ(1 − φᵐ))/(m(1 − φ))², φ = e^−h, and covariance φ^{(k−1)m + 1} ((1 − φᵐ)/(m(1 − φ)))² k
  // averages apart.
  [[nodiscard]] double of_differences(std::size_t lag, double interval, std::size_t samples) const {
    const double h = interval / tau, m = static_cast<double>(samples), l = static_cast<double>(lag);
    const double phi = std::exp(-h), off = -std::expm1(-h), all_off = -std::expm1(-m * h),
                 scale = variance / (m * m * off * off);
    const double own = scale * (m * off * (1 + phi) - 2 * phi * all_off), neighbour = scale * phi * all_off * all_off;
    if (lag == 0) return 2 * (own - neighbour);
    if (lag == 1) return neighbour * (1 + all_off) - own;
    return -neighbour * std::exp(-(l - 2) * m * h) * all_off * all_off;
  }
};

template <typename Scalar, std::size_t Stages, int N>
std::vector<Process> processes(const BiasInstability<Scalar, Stages, N>& term, double coefficient = 1) {
  std::vector<Process> result;
  for (const auto& [tau, deviation, step] : term.stages(Scalar(0.005)))
    result.push_back({std::pow(coefficient * static_cast<double>(deviation), 2), static_cast<double>(tau)});
  return result;
}

// How far the Allan deviation is from B·√(2 ln 2/π), at worst, between two averaging times.
double ripple(const std::vector<Process>& sum, double shortest, double longest) {
  double worst = 0;
  for (int i = 0; i <= 500; ++i) {
    const double T = shortest * std::pow(longest / shortest, i / 500.0);
    double variance = 0;
    for (const Process& p : sum) variance += p.allan_variance(T);
    worst = std::max(worst, std::abs(std::sqrt(variance / (2 * std::numbers::ln2 / pi)) - 1));
  }
  return worst;
}

// How far the spectral density is from B²/(2πf), at worst, between two frequencies.
double spectral_ripple(const std::vector<Process>& sum, double lowest, double highest) {
  double worst = 0;
  for (int i = 0; i <= 500; ++i) {
    const double f = lowest * std::pow(highest / lowest, i / 500.0);
    double density = 0;
    for (const Process& p : sum) density += p.density(f);
    worst = std::max(worst, std::abs(density * 2 * pi * f - 1));
  }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("The Allan deviation is as flat as its documentation says", "", float, double) {
  using Scalar = TestType;
  const auto sum = processes(BiasInstability<Scalar>(Scalar(1)));
  CHECK(ripple(sum, 1, 3600) < 0.02);
  CHECK(ripple(sum, 1, 3600) > 0.01);  // the test sees ripples
  CHECK(ripple(sum, 10, 360) < 0.004);
  // Ratios of 7, 10 and 18.
  const auto with_ratio = [](double r) {
    const double longest = std::pow(r, 7) / 10;
    const auto processes_8 =
        processes(BiasInstability<Scalar, 8>(Scalar(1), {Scalar(1), static_cast<Scalar>(longest)}));
    return std::pair(ripple(processes_8, 1, longest), ripple(processes_8, 10, longest / 10));
  };
  CHECK(with_ratio(7).first < 0.02);
  CHECK(with_ratio(7).second < 0.004);
  CHECK(with_ratio(10).second < 0.0105);
  CHECK(with_ratio(10).second > 0.0095);
  CHECK(with_ratio(18).second < 0.033);
  CHECK(with_ratio(18).second > 0.029);
  // A band in other units of time is the same.
  CHECK_THAT(ripple(processes(BiasInstability<Scalar>(Scalar(1), {Scalar(1e-3), Scalar(3.6)})), 1e-3, 3.6),
             WithinRel(ripple(sum, 1, 3600), 1e-4));
}

TEST_CASE("The spectral density is B²/(2 pi f) in the band") {
  const auto sum = processes(BiasInstability(1.0));
  CHECK(spectral_ripple(sum, 1.0 / 3600, 0.25) < 0.015);
  const auto density = [&](double f) {
    double result = 0;
    for (const Process& p : sum) result += p.density(f);
    return result;
  };
  CHECK_THAT(density(1e-7) / density(1e-6), WithinRel(1, 0.01));   // flat below
  CHECK_THAT(density(100) / density(1000), WithinRel(100, 0.01));  // 1/f² above
}

TEMPLATE_TEST_CASE("Records have that Allan variance, whatever the rate", "", float, double) {
  using Scalar = TestType;
  const double coefficient[] = {1e-3, 0.5, 7};
  const BiasInstability term(per_axis<Scalar>(coefficient));
  for (const double rate : rates) {
    // A million samples of three axes together.
    const Record errors = record<Scalar>(ErrorModel{term}, regular(rate, million / 3 + 1), 15);
    CHECK(errors.all_bias);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto sum = processes(term, coefficient[axis]);
      for (const double T : {0.2, 2.0, 20.0}) {
        INFO(rate << " Hz, axis " << axis << ", " << T << " s");
        const auto m = static_cast<std::size_t>(std::lround(T * rate));
        const auto D = [&](std::size_t l) {
          double result = 0;
          for (const Process& p : sum) result += p.of_differences(l, 1 / rate, m);
          return result;
        };
        // In the band, averages of samples are those of continuous time.
        if (T > 1) CHECK_THAT(std::sqrt(D(0) / 2) / (coefficient[axis] * 0.66428), WithinAbs(1, 0.02));
        CHECK(off(allan_variance(errors.axes[axis], m, D, 300)) < 4);
      }
    }
  }
}

TEST_CASE("Records at irregular intervals do what those at regular ones do in the same time") {
  constexpr double B = 0.5;
  const BiasInstability term(B);
  const auto sum = processes(term, B);
  const Intervals intervals = irregular(200, million / 3 + 1);
  const std::vector<double> t = times(intervals);
  const Record errors = record<double>(ErrorModel{term}, intervals, 16);
  for (const std::size_t span : {20U, 200U, 2000U}) {
    // Squares of the changes d_i over times T_i, one after the other. E d_i² = 2 Σ σ²(1 − e^{−T_i/τ}), and the mean of
    // d² over M of them has variance 2/M² Σ_ij C_ij² with C_ij = −Σ σ² (1 − e^{−T_i/τ}) e^{−gap/τ} (1 − e^{−T_j/τ}) for
    // i before j. Squared, that is a double sum over processes, and each of its parts runs along the record.
    const std::size_t M = (t.size() - 1) / span, S = sum.size();
    double expected = 0, squares = 0;
    std::vector<double> before(S * S, 0.0), change(S);
    for (std::size_t i = 0; i < M; ++i) {
      const double T = t[(i + 1) * span] - t[i * span];
      double own = 0;
      for (std::size_t s = 0; s < S; ++s) {
        change[s] = -std::expm1(-T / sum[s].tau);
        own += 2 * sum[s].variance * change[s];
      }
      expected += own / static_cast<double>(M);
      squares += own * own;
      for (std::size_t s = 0; s < S; ++s) {
        for (std::size_t u = 0; u < S; ++u) {
          const double both = sum[s].variance * sum[u].variance * change[s] * change[u];
          squares += 2 * both * before[s * S + u];
          // What came before is further away by T, and this change is added, in units of what it ends with.
          before[s * S + u] = before[s * S + u] * (1 - change[s]) * (1 - change[u]) + change[s] * change[u];
        }
      }
    }
    const double standard_error = std::sqrt(2 * squares) / static_cast<double>(M);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      INFO("axis " << axis << ", " << span << " samples");
      const std::vector<double>& x = errors.axes[axis];
      double mean = 0;
      for (std::size_t i = 0; i < M; ++i) mean += std::pow(x[(i + 1) * span] - x[i * span], 2) / static_cast<double>(M);
      CHECK(off({mean, expected, standard_error}) < 4);
    }
  }
}

TEMPLATE_TEST_CASE("The first sample is drawn from the stationary law", "", float, double) {
  using Scalar = TestType;
  const BiasInstability<Scalar> term(Scalar(3));
  double variance = 0;
  for (const Process& p : processes(term, 3)) variance += p.variance;
  std::vector<double> first;
  for (std::uint64_t seed = 0; seed < 50'000; ++seed)
    first.push_back(record<Scalar>(ErrorModel{term}, regular(200, 1), seed).axes[2][0] / std::sqrt(variance));
  for (const std::size_t lag : {0U, 1U}) CHECK(off(white_autocovariance(first, lag)) < 4);
}

TEST_CASE("The processes of the sum and the axes are independent") {
  // Two processes with correlation times 0.2 µs and 20 ms: samples at 1 Hz are white.
  const BiasInstability<double, 2> term(1, {1e-6, 1e-2});
  double variance = 0;
  for (const Process& p : processes(term)) variance += p.variance;
  Record errors = record<double>(ErrorModel{term}, regular(1, 200'000), 17);
  for (auto& axis : errors.axes)
    for (double& x : axis) x /= std::sqrt(variance);
  for (const auto& axis : errors.axes)
    for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(axis, lag)) < 4);
  CHECK(off(mean_product(errors.axes[0], errors.axes[1])) < 4);
  CHECK(off(mean_product(errors.axes[1], errors.axes[2])) < 4);
  CHECK(off(mean_product(errors.axes[2], errors.axes[0])) < 4);
}

TEST_CASE(
    "A coefficient is given as a number, one for each axis, or a vector; a band and a number of stages if wanted") {
  STATIC_CHECK(std::is_same_v<decltype(BiasInstability{0.1F}), BiasInstability<float>>);
  STATIC_CHECK(std::is_same_v<decltype(BiasInstability{1}), BiasInstability<double, 7>>);
  STATIC_CHECK(std::is_same_v<decltype(BiasInstability{PerAxis<float>(1, 2, 3)}), BiasInstability<float, 7, 3>>);
  CHECK(BiasInstability{Eigen::Vector3d(1, 2, 3)}.coefficient[2] == 3);
  CHECK(BiasInstability{1, FlickerBand<>{0.1, 100}}.band.longest == 100);
  CHECK(BiasInstability<double, 12>(1).stages(0.01).size() == 12);
}

TEST_CASE("What is no bias instability is refused") {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(BiasInstability(-1.0), "BiasInstability: coefficient B is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(BiasInstability(nan), "BiasInstability: coefficient B is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(BiasInstability<>(1, {0, 10}),
                    "BiasInstability: shortest averaging time is 0, expected a finite number > 0");
  CHECK_THROWS_WITH(BiasInstability<>(1, {nan, 10}),
                    "BiasInstability: shortest averaging time is nan, expected a finite number > 0");
  CHECK_THROWS_WITH(BiasInstability<>(1, {10, 10}),
                    "BiasInstability: longest averaging time is 10, expected a finite number above the shortest");
  CHECK_THROWS_WITH(BiasInstability<>(1, {1, infinity}),
                    "BiasInstability: longest averaging time is inf, expected a finite number above the shortest");
}
