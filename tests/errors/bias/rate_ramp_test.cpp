// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("The bias is the slope times the time since the first sample", "", float, double) {
  using Vector = Vector3<TestType>;
  const RateRamp term{PerAxis<TestType>(1, TestType(-0.5), 0)};
  const auto first = applied(term, sample_with<TestType>(Vector(1, 2, 3), Vector(4, 5, 6)));
  CHECK(first.value == Vector(1, 2, 3));
  CHECK(first.bias == Vector(4, 5, 6));
  const auto later = applied(term, sample_with<TestType>(Vector(1, 2, 3), Vector(4, 5, 6), TestType(8)));
  CHECK(later.value == Vector(9, -2, 3));
  CHECK(later.bias == Vector(12, 1, 6));
}

TEST_CASE("In a run it starts with the run, at any rate, and rounding does not add up") {
  const Imu imu{ErrorModel{RateRamp{0.1}}, ErrorModel{}};
  for (const double rate : {3.0, 1000.0}) {
    for (const auto& r : simulate(at_rest(SO3xR3<double>{}), imu, {.rate = rate, .start = 50.0, .end = 60.0}))
      REQUIRE(r.gyro == Eigen::Vector3d::Constant(0.1 * (r.time - 50)));
  }
}

TEST_CASE("A slope is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(RateRamp{1}), RateRamp<double>>);
  STATIC_CHECK(std::is_same_v<decltype(RateRamp{0.1F}), RateRamp<float>>);
  CHECK(RateRamp{Eigen::Vector3d(1, 2, 3)}.slope[1] == 2);
  static constexpr ErrorModel model{RateRamp{-0.25}};
  STATIC_CHECK(std::get<0>(model.terms()).slope[2] == -0.25);
}

TEST_CASE("A slope that is none is refused") {
  CHECK_THROWS_WITH((RateRamp{PerAxis<double>(0, testing::nan<double>, 0)}),
                    "RateRamp: slope is nan, expected a finite number");
  CHECK_THROWS_WITH(RateRamp{testing::infinity<float>}, "RateRamp: slope is inf, expected a finite number");
}

TEST_CASE("A rate ramp in words") {
  CHECK(describe(RateRamp{0.1}, SensorKind::gyro) == "rate ramp: slope 0.1 rad/s^2");
  CHECK(describe(RateRamp{0.1}, SensorKind::accel) == "rate ramp: slope 0.1 m/s^3");
}
