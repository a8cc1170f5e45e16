// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/temperature_bias.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <type_traits>
#include <utility>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

namespace {
constexpr auto heating = [](double elapsed) { return 20 + elapsed / 2; };
}  // namespace

TEMPLATE_TEST_CASE("The bias is in proportion to how far the temperature is from the reference", "", float, double) {
  using Vector = Vector3<TestType>;
  const TemperatureBias term{PerAxis<TestType>(1, -2, 0), heating, TestType(30)};
  for (const auto& [elapsed, difference] : {std::pair(0, -10), std::pair(20, 0), std::pair(40, 10)}) {
    const auto sample =
        applied(term, sample_with<TestType>(Vector(1, 2, 3), Vector(4, 5, 6), static_cast<TestType>(elapsed)));
    const Vector bias = Vector(1, -2, 0) * static_cast<TestType>(difference);
    CHECK(sample.value == Vector(1, 2, 3) + bias);
    CHECK(sample.bias == Vector(4, 5, 6) + bias);
  }
}

TEST_CASE("A sensor that warms up in a run: time counts from the run's first sample") {
  const WarmUp profile{20, 60, 10};
  const Imu imu{ErrorModel{TemperatureBias{0.01, profile}}, ErrorModel{}};
  for (const auto& r : simulate(at_rest(SO3xR3<double>{}), imu, {.rate = 10, .start = 1000.0, .end = 1030.0})) {
    const double bias = 0.01 * (profile(r.time - 1000) - 25);  // the reference where none is given
    REQUIRE(r.gyro == Eigen::Vector3d::Constant(bias));
    REQUIRE(r.gyro_bias == r.gyro);
    REQUIRE(r.accel_bias.isZero(0));
  }
}

TEST_CASE("Coefficients in every form, with profiles of every kind") {
  STATIC_CHECK(std::is_same_v<decltype(TemperatureBias{1, heating}),
                              TemperatureBias<double, std::remove_const_t<decltype(heating)>>>);
  STATIC_CHECK(std::is_same_v<decltype(TemperatureBias{0.1F, WarmUp{20.0F, 60.0F, 300.0F}}),
                              TemperatureBias<float, WarmUp<float>>>);
  STATIC_CHECK(
      std::is_same_v<decltype(TemperatureBias{0.1, WarmUp{20, 60, 300}, 20}), TemperatureBias<double, WarmUp<double>>>);
  CHECK(TemperatureBias{Eigen::Vector3d(1, 2, 3), heating}.coefficient[2] == 3);
  CHECK(TemperatureBias{PerAxis<double>(1, 2, 3), heating, 20}.reference == 20);
  const double slope = 3;
  const auto captures = [&](double elapsed) { return slope * elapsed; };
  CHECK(applied(TemperatureBias{1, captures, 0}, sample_with<double>(Eigen::Vector3d(1, 2, 3), {0, 0, 0}, 2.0)).value ==
        Eigen::Vector3d(7, 8, 9));
}

TEST_CASE("It can be made while compiling") {
  static constexpr ErrorModel model{TemperatureBias{0.25, WarmUp{20, 60, 300}, 30}, TemperatureBias{0.5, heating}};
  STATIC_CHECK(std::get<0>(model.terms()).reference == 30);
}

TEST_CASE("A temperature bias that is none is refused") {
  CHECK_THROWS_WITH((TemperatureBias{testing::nan<double>, heating}),
                    "TemperatureBias: coefficient is nan, expected a finite number");
  CHECK_THROWS_WITH((TemperatureBias{0.1, heating, testing::infinity<double>}),
                    "TemperatureBias: reference temperature is inf, expected a finite number");
}

TEST_CASE("A temperature bias in words") {
  CHECK(describe(TemperatureBias{0.1, WarmUp{20, 60, 300}}, SensorKind::gyro) ==
        "temperature bias: coefficient 0.1 rad/s/K, initial temperature 20 degC, final temperature 60 degC, "
        "time constant 300 s, reference temperature 25 degC");
  CHECK(describe(TemperatureBias{0.1, heating, 20}, SensorKind::accel) ==
        "temperature bias: coefficient 0.1 m/s^2/K, reference temperature 20 degC");
}
