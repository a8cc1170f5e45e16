// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/noise/random_vibration.hpp>
#include <splinertia/errors/output/sinusoidal_vibration.hpp>
#include <splinertia/errors/scale/vibration_rectification.hpp>

#include "errors/one_term.hpp"
#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("The square of the reading is added, and nothing to the bias", "", float, double) {
  using Vector = Eigen::Vector3<TestType>;
  const VibrationRectification term{PerAxis<TestType>(TestType(0.5), TestType(0.5), -1)};
  const auto sample = applied(term, sample_with<TestType>(Vector(4, -4, 1), Vector(8, 8, 8)));
  CHECK(sample.value == Vector(12, 4, 0));
  CHECK(sample.bias == Vector(8, 8, 8));
}

TEST_CASE("Vibration of standard deviation s shifts the mean by K s²") {
  // Whole periods of a sine of amplitude A: s² = A²/2.
  const ErrorModel sine{SinusoidalVibration{3, 20}, VibrationRectification{0.01}};
  const auto x = testing::record<double>(sine, testing::regular(200, 1000), 1).axes[0];
  double sum = 0;
  for (const double value : x) sum += value / 1000;
  CHECK(std::abs(sum - 0.01 * 4.5) < 1e-12);
  // Random vibration that is nearly white: neighbouring samples 1 s apart, ζω = 63/s.
  const ErrorModel random{RandomVibration{3, 100, 0.1}, VibrationRectification{0.01}};
  const auto y = testing::record<double>(random, testing::regular(1, 100'000), 1).axes[0];
  sum = 0;
  for (const double value : y) sum += value / 1e5;
  CHECK(std::abs(sum - 0.09) < 4 * 3 / std::sqrt(1e5));
}

TEST_CASE("A rectification must not overflow, and has its unit") {
  CHECK_THROWS_AS(VibrationRectification{1e200}, std::invalid_argument);
  CHECK(describe(VibrationRectification{1e-6}, SensorKind::accel) ==
        "vibration rectification: coefficient 1e-06 1/(m/s^2)");
}
