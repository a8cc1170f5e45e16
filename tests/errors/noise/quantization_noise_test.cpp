// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/errors/noise/quantization_noise.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

TEMPLATE_TEST_CASE("Samples of quantization noise have variance 2Q²/dt² and Allan deviation root 3 Q/tau", "", float,
                   double) {
  using Scalar = TestType;
  const double Q[] = {1e-4, 2, 0.3};
  const ErrorModel model{QuantizationNoise(per_axis<Scalar>(Q))};
  for (const double rate : rates) {
    const Record errors = record<Scalar>(model, regular(rate), 13);
    CHECK(errors.no_bias);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      INFO(rate << " Hz, axis " << axis);
      const double square = std::pow(Q[axis] * rate, 2);
      const auto C = [&](std::size_t l) { return l == 0 ? 2 * square : l == 1 ? -square : 0; };
      for (const std::size_t lag : {0U, 1U, 2U, 3U}) CHECK(off(autocovariance(errors.axes[axis], C, lag, 2)) < 4);
      for (const std::size_t m : {1U, 10U, 100U, 1000U}) {
        // Averages are (q_end − q_begin)/τ; their differences are second differences of the q, 1, −2, 1.
        const double tau = static_cast<double>(m) / rate, unit = std::pow(Q[axis] / tau, 2);
        const auto D = [&](std::size_t l) { return unit * (l == 0 ? 6 : l == 1 ? -4 : l == 2 ? 1 : 0); };
        const Estimate allan = allan_variance(errors.axes[axis], m, D, 3);
        CHECK_THAT(std::sqrt(allan.expected), WithinRel(std::sqrt(3) * Q[axis] / tau, 1e-12));
        CHECK(off(allan) < 4);
      }
    }
  }
}

TEMPLATE_TEST_CASE("The integral of the reading is off by white noise of deviation Q at irregular intervals, too", "",
                   float, double) {
  using Scalar = TestType;
  const Intervals intervals = irregular(200);
  const Record errors = record<Scalar>(ErrorModel{QuantizationNoise{Scalar(0.5)}}, intervals, 14);
  std::array<std::vector<double>, 3> numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    INFO("axis " << axis);
    // q_i − q_before for all i: their mean is −q_before, to a standard error of Q/1000.
    double integral = 0, mean = 0;
    for (std::size_t i = 0; i < million; ++i) {
      integral += errors.axes[axis][i] * static_cast<double>(static_cast<Scalar>(intervals[i]));
      numbers[axis].push_back(integral / 0.5);
      mean += integral / 0.5 / million;
    }
    for (double& x : numbers[axis]) x -= mean;
    // Taking the mean off takes 1/M off the variance, a thousandth of its standard error √(2/M).
    for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(numbers[axis], lag)) < 4);
    CHECK(std::abs(mean) < 6);
  }
  CHECK(off(mean_product(numbers[0], numbers[1])) < 4);
  CHECK(off(mean_product(numbers[1], numbers[2])) < 4);
  CHECK(off(mean_product(numbers[2], numbers[0])) < 4);
}

TEST_CASE("The first sample is as noisy as all others") {
  std::vector<double> first;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed)
    first.push_back(record<double>(ErrorModel{QuantizationNoise{3}}, regular(200, 1), seed).axes[0][0] /
                    (600 * std::sqrt(2)));
  for (const std::size_t lag : {0U, 1U}) CHECK(off(white_autocovariance(first, lag)) < 4);
}

TEST_CASE("A coefficient is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(QuantizationNoise{0.1F}), QuantizationNoise<float>>);
  STATIC_CHECK(std::is_same_v<decltype(QuantizationNoise{1}), QuantizationNoise<double>>);
  STATIC_CHECK(std::is_same_v<decltype(QuantizationNoise{PerAxis<float>(1, 2, 3)}), QuantizationNoise<float, 3>>);
  CHECK(QuantizationNoise{Eigen::Vector3d(1, 2, 3)}.coefficient[2] == 3);
}

TEST_CASE("A coefficient that is none is refused") {
  CHECK_THROWS_WITH(QuantizationNoise{-1.0}, "QuantizationNoise: coefficient Q is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(QuantizationNoise{std::nan("")},
                    "QuantizationNoise: coefficient Q is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(QuantizationNoise{std::numeric_limits<double>::infinity()},
                    "QuantizationNoise: coefficient Q is inf, expected a finite number >= 0");
}
