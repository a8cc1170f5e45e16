// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/imu/describe.hpp>
#include <splinertia/imu/errors/g_squared_sensitivity.hpp>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("The square of the true specific force is added to the reading, and not to the bias", "", float,
                   double) {
  using Vector = Eigen::Vector3<TestType>;
  auto sample = sample_with<TestType>(Vector(1, 2, 3), Vector(4, 5, 6));
  sample.truth = {Vector(7, 7, 7), Vector(1, -2, 4)};
  sample = applied(GSquaredSensitivity{PerAxis<TestType>(1, TestType(0.5), -1)}, sample);
  CHECK(sample.value == Vector(2, 4, -13));
  CHECK(sample.bias == Vector(4, 5, 6));
}

TEMPLATE_TEST_CASE("An axis without sensitivity reads what it should under any force", "", float, double) {
  using Scalar = TestType;
  const Eigen::Vector3<Scalar> huge = Eigen::Vector3<Scalar>::Constant(std::numeric_limits<Scalar>::max());
  auto sample = sample_with<Scalar>(Eigen::Vector3<Scalar>::Ones());
  sample.truth = {Eigen::Vector3<Scalar>::Zero(), huge};
  sample = applied(GSquaredSensitivity{PerAxis<Scalar>(0, 1 / huge[0], 1)}, sample);
  CHECK(sample.value.x() == 1);
  CHECK(sample.value.y() == Approx(huge[0]));
  CHECK(sample.value.z() == std::numeric_limits<Scalar>::infinity());
}

TEST_CASE("A g-squared sensitivity in words, and refused") {
  CHECK(describe(GSquaredSensitivity{1e-6}, SensorKind::gyro) ==
        "g-squared sensitivity: sensitivity 1e-06 rad/s/(m/s^2)^2");
  CHECK_THROWS_AS(GSquaredSensitivity{1e300}, std::invalid_argument);
}
