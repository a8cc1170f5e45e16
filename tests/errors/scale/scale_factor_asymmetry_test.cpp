// SPDX-License-Identifier: MIT
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/scale/scale_factor_asymmetry.hpp>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("The slope is 1 + a/2 for positive readings and 1 - a/2 for negative ones", "", float, double) {
  using Vector = Eigen::Vector3<TestType>;
  const ScaleFactorAsymmetry term{PerAxis<TestType>(TestType(0.5), TestType(0.5), TestType(-1))};
  const auto sample = applied(term, sample_with<TestType>(Vector(4, -4, 4), Vector(8, 8, 8)));
  CHECK(sample.value == Vector(5, -3, 2));
  CHECK(sample.bias == Vector(10, 6, 4));
  CHECK(applied(term, sample_with<TestType>(Vector(0, 0, 0))).value == Vector(0, 0, 0));
}

TEST_CASE("Both slopes must be positive") {
  CHECK_NOTHROW(ScaleFactorAsymmetry{-1.99});
  CHECK_THROWS_WITH(ScaleFactorAsymmetry{2}, "ScaleFactorAsymmetry: asymmetry is 2, expected a number > -2 and < 2");
  CHECK_THROWS_AS(ScaleFactorAsymmetry{testing::nan<double>}, std::invalid_argument);
}

TEST_CASE("An asymmetry in words") {
  CHECK(describe(ScaleFactorAsymmetry{1e-3}, SensorKind::gyro) == "scale factor asymmetry: asymmetry 0.001");
}
