// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/errors/noise/gauss_markov.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using namespace splinertia::testing;

namespace {

// A record's steps over their deviations: (x_{i+1} − e^{−h/τ} x_i)/(σ √(1 − e^{−2h/τ})), independent standard normal
// numbers whatever the intervals h, and so exact for irregular ones.
std::vector<double> innovations(const std::vector<double>& x, const Intervals& intervals, double sigma, double tau) {
  std::vector<double> result;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double h = intervals[i] / tau;
    result.push_back((x[i] - std::exp(-h) * x[i - 1]) / (sigma * std::sqrt(-std::expm1(-2 * h))));
  }
  return result;
}

}  // namespace

TEMPLATE_TEST_CASE("The autocovariance is that of a Gauss-Markov process, whatever the rate", "", float, double) {
  using Scalar = TestType;
  const double sigma[] = {0.3, 2, 5}, tau[] = {0.05, 0.5, 3};
  const ErrorModel model{GaussMarkov(per_axis<Scalar>(sigma), per_axis<Scalar>(tau))};
  for (const double rate : rates) {
    const Record errors = record<Scalar>(model, regular(rate), 10);
    CHECK(errors.all_bias);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = [&](double t) { return sigma[axis] * sigma[axis] * std::exp(-t / tau[axis]); };
      const auto C = [&](std::size_t l) { return at(static_cast<double>(l) / rate); };
      const auto reach = static_cast<std::size_t>(20 * tau[axis] * rate);
      for (const double t : {0.0, 0.02, 0.1, 0.5, 2.0}) {
        INFO(rate << " Hz, axis " << axis << ", " << t << " s");
        const Estimate e = autocovariance(errors.axes[axis], C, static_cast<std::size_t>(std::lround(t * rate)), reach);
        CHECK_THAT(e.expected, WithinRel(at(t), 1e-12));  // the same at all rates
        CHECK(off(e) < 4);
      }
    }
  }
}

TEMPLATE_TEST_CASE("Steps of any size and regularity are those of a Gauss-Markov process", "", float, double) {
  using Scalar = TestType;
  const double sigma[] = {0.3, 2, 5}, tau[] = {0.004, 0.5, 300};
  const ErrorModel model{GaussMarkov(per_axis<Scalar>(sigma), per_axis<Scalar>(tau))};
  const Intervals intervals = irregular(200);
  const Record errors = record<Scalar>(model, intervals, 11);
  std::array<std::vector<double>, 3> numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    INFO("axis " << axis);
    const std::vector<double>& x = errors.axes[axis];
    numbers[axis] = innovations(x, intervals, sigma[axis], tau[axis]);
    for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(numbers[axis], lag)) < 4);
    // The mean of x² has variance 2/M² Σ_ij C_ij², a sum that runs along the record as S_i = e^{−2h/τ}(1 + S_{i−1}).
    double sum = 0, S = 0, squares = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (i > 0) S = std::exp(-2 * intervals[i] / tau[axis]) * (1 + S);
      sum += x[i] * x[i] / million;
      squares += (1 + 2 * S) / million;
    }
    const double variance = sigma[axis] * sigma[axis];
    CHECK(off({sum, variance, variance * std::sqrt(2 * squares / million)}) < 4);
  }
  CHECK(off(mean_product(numbers[0], numbers[1])) < 4);
  CHECK(off(mean_product(numbers[1], numbers[2])) < 4);
  CHECK(off(mean_product(numbers[2], numbers[0])) < 4);
}

TEMPLATE_TEST_CASE("The first sample is drawn from the stationary law", "", float, double) {
  using Scalar = TestType;
  const ErrorModel model{GaussMarkov{Scalar(2), Scalar(1000)}};
  std::vector<double> first;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed)
    first.push_back(record<Scalar>(model, regular(200, 1), seed).axes[1][0] / 2);
  for (const std::size_t lag : {0U, 1U}) CHECK(off(white_autocovariance(first, lag)) < 4);
}

TEMPLATE_TEST_CASE("From a given value it forgets it, and reaches the stationary law", "", float, double) {
  using Scalar = TestType;
  // Over runs, 0.3 s after x0 the mean is x0 e^{−0.3/τ} and the variance σ²(1 − e^{−0.6/τ}), at any rate.
  for (const double rate : {50.0, 1000.0}) {
    const double initial[] = {7, 0, -1};
    const GaussMarkov term(Scalar(2), Scalar(0.5), per_axis<Scalar>(initial));
    const auto last = static_cast<std::size_t>(std::lround(0.3 * rate));
    constexpr std::size_t runs = 2000;
    std::array<std::vector<double>, 3> z;
    bool starts_there = true;
    for (std::uint64_t seed = 0; seed < runs; ++seed) {
      const Record errors = record<Scalar>(ErrorModel{term}, regular(rate, last + 1), seed);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& x = errors.axes[axis];
        starts_there = starts_there && x[0] == initial[axis];
        z[axis].push_back((x[last] - initial[axis] * std::exp(-0.6)) / (2 * std::sqrt(-std::expm1(-1.2))));
      }
    }
    CHECK(starts_there);
    for (const std::vector<double>& axis : z) {
      CHECK(off(mean_product(axis, std::vector<double>(runs, 1.0))) < 4);
      CHECK(off(white_autocovariance(axis, 0)) < 4);
    }
  }
}

TEMPLATE_TEST_CASE("One step keeps the variance, from the shortest to the longest", "", float, double) {
  using Scalar = TestType;
  const double eps = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  for (double h = 1e-30; h < 1e30; h *= 1.7) {
    INFO(h << " correlation times");
    const GaussMarkovStep<Scalar> step{static_cast<Scalar>(h)};
    const double forget = static_cast<double>(step.gain), deviation = static_cast<double>(step.deviation);
    const double exact = -std::expm1(-static_cast<double>(static_cast<Scalar>(h)));
    CHECK_THAT(forget, WithinRel(exact, 4 * eps));
    CHECK_THAT(deviation * deviation, WithinRel(exact * (2 - exact), 8 * eps));
  }
}

TEMPLATE_TEST_CASE("A correlation time far above or below the interval is right, too", "", float, double) {
  using Scalar = TestType;
  // h/τ = 1e9: white noise. h/τ = 1e-9: it stays where it was but for steps of deviation √2e-9 σ.
  const ErrorModel model{GaussMarkov(Scalar(3), PerAxis<Scalar>(Scalar(0.005e-9), Scalar(0.005e9), Scalar(0.005)))};
  const Intervals intervals = regular(200);
  const Record errors = record<Scalar>(model, intervals, 12);
  const auto C = [](std::size_t l) { return l == 0 ? 9.0 : 0.0; };
  for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(autocovariance(errors.axes[0], C, lag, 1)) < 4);
  const std::vector<double> z = innovations(errors.axes[1], intervals, 3, 0.005e9);
  for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(z, lag)) < 4);
  // A step of h/τ = 1e60 or 1e-60 is still a number.
  for (const Scalar tau : {std::numeric_limits<Scalar>::min(), std::numeric_limits<Scalar>::max()}) {
    const Record extreme = record<Scalar>(ErrorModel{GaussMarkov<Scalar>(Scalar(1), tau)}, regular(200, 100), 1);
    for (const auto& axis : extreme.axes)
      for (const double x : axis) CHECK(std::abs(x) < 6);
  }
}

TEST_CASE("No deviation is no error") {
  for (const auto& axis : record<double>(ErrorModel{GaussMarkov{0, 1}}, regular(50, 100), 1).axes)
    CHECK(axis == std::vector<double>(100, 0.0));
}

TEST_CASE("Parameters of a Gauss-Markov process are given as numbers, one for each axis, or vectors") {
  STATIC_CHECK(std::is_same_v<decltype(GaussMarkov{0.1F, 2.0F}), GaussMarkov<float>>);
  STATIC_CHECK(std::is_same_v<decltype(GaussMarkov{1, 2}), GaussMarkov<double>>);
  STATIC_CHECK(std::is_same_v<decltype(GaussMarkov{PerAxis<float>(1, 2, 3), 2.0F}), GaussMarkov<float, 3>>);
  const GaussMarkov term{Eigen::Vector3d(1, 2, 3), 100, 0.5};
  CHECK(term.standard_deviation[1] == 2);
  CHECK(term.correlation_time[2] == 100);
  CHECK(term.initial->vector() == Eigen::Vector3d::Constant(0.5));
  CHECK(!GaussMarkov{1, 2}.initial);
  CHECK((*GaussMarkov{1.0, 2.0, Eigen::Vector3d(1, 2, 3)}.initial)[2] == 3);
}

TEST_CASE("What is no Gauss-Markov process is refused") {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(GaussMarkov(-1.0, 1.0), "GaussMarkov: standard deviation is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(GaussMarkov(nan, 1.0), "GaussMarkov: standard deviation is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(GaussMarkov(1, 0), "GaussMarkov: correlation time is 0, expected a finite number > 0");
  CHECK_THROWS_WITH(GaussMarkov(1.0, -2.5), "GaussMarkov: correlation time is -2.5, expected a finite number > 0");
  CHECK_THROWS_WITH(GaussMarkov(1.0, nan), "GaussMarkov: correlation time is nan, expected a finite number > 0");
  CHECK_THROWS_WITH(GaussMarkov(1.0, Eigen::Vector3d(1, infinity, 1)),
                    "GaussMarkov: correlation time is inf, expected a finite number > 0");
  CHECK_THROWS_WITH(GaussMarkov(1.0, 1.0, nan), "GaussMarkov: initial value is nan, expected a finite number");
}
