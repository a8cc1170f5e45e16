// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/errors/noise/white_noise.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

TEMPLATE_TEST_CASE("Samples of white noise have variance N²/dt and Allan deviation N/root tau", "", float, double) {
  using Scalar = TestType;
  const double density[] = {0.015, 0, 2};
  const ErrorModel model{WhiteNoise(per_axis<Scalar>(density))};
  for (const double rate : rates) {
    const Record errors = record<Scalar>(model, regular(rate), 5);
    CHECK(errors.no_bias);
    for (const std::size_t axis : {0U, 2U}) {
      INFO(rate << " Hz, axis " << axis);
      const std::vector<double>& x = errors.axes[axis];
      const double variance = density[axis] * density[axis] * rate;
      const auto C = [&](std::size_t l) { return l == 0 ? variance : 0; };
      for (const std::size_t lag : {0U, 1U, 2U, 10U}) CHECK(off(autocovariance(x, C, lag, 1)) < 4);
      for (const std::size_t m : {1U, 10U, 100U, 1000U}) {
        // Differences of neighbouring averages share one of them.
        const double tau = static_cast<double>(m) / rate, average = density[axis] * density[axis] / tau;
        const auto D = [&](std::size_t l) { return l == 0 ? 2 * average : -average; };
        const Estimate allan = allan_variance(x, m, D, 2);
        CHECK_THAT(std::sqrt(allan.expected), WithinRel(density[axis] / std::sqrt(tau), 1e-12));
        CHECK(off(allan) < 4);
      }
    }
    CHECK(errors.axes[1] == std::vector<double>(million, 0.0));
  }
}

TEMPLATE_TEST_CASE("The integral of white noise over a time T has variance N²T at irregular intervals, too", "", float,
                   double) {
  using Scalar = TestType;
  const Intervals intervals = irregular(200);
  const ErrorModel model{WhiteNoise{Scalar(0.1)}};
  const Record errors = record<Scalar>(model, intervals, 6);
  std::array<std::vector<double>, 3> numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    INFO("axis " << axis);
    const std::vector<double>& x = errors.axes[axis];
    for (std::size_t i = 0; i < x.size(); ++i) numbers[axis].push_back(x[i] * std::sqrt(intervals[i]) / 0.1);
    for (const std::size_t lag : {0U, 1U, 2U}) CHECK(off(white_autocovariance(numbers[axis], lag)) < 4);
    std::vector<double> integrals;  // over 100 samples each, in units of their deviation
    for (std::size_t i = 0; i < x.size();) {
      double integral = 0, duration = 0;
      for (const std::size_t end = i + 100; i < end; ++i) {
        integral += x[i] * intervals[i];
        duration += intervals[i];
      }
      integrals.push_back(integral / (0.1 * std::sqrt(duration)));
    }
    for (const std::size_t lag : {0U, 1U}) CHECK(off(white_autocovariance(integrals, lag)) < 4);
  }
  CHECK(off(mean_product(numbers[0], numbers[1])) < 4);
  CHECK(off(mean_product(numbers[1], numbers[2])) < 4);
  CHECK(off(mean_product(numbers[2], numbers[0])) < 4);
}

TEST_CASE("A density is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{0.1}), WhiteNoise<double>>);
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{0.1F}), WhiteNoise<float>>);
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{2}), WhiteNoise<double>>);
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{PerAxis<double>(1, 2, 3)}), WhiteNoise<double, 3>>);
  CHECK(WhiteNoise{Eigen::Vector3d(1, 2, 3)}.density[1] == 2);
  CHECK(WhiteNoise{2}.density[2] == 2);
}

TEST_CASE("A density that is none is refused") {
  CHECK_THROWS_WITH(WhiteNoise{-0.1}, "WhiteNoise: density is -0.1, expected a finite number >= 0");
  CHECK_THROWS_WITH(WhiteNoise{std::nan("")}, "WhiteNoise: density is nan, expected a finite number >= 0");
  CHECK_THROWS_WITH(WhiteNoise{Eigen::Vector3d(0, 1, std::numeric_limits<double>::infinity())},
                    "WhiteNoise: density is inf, expected a finite number >= 0");
}
