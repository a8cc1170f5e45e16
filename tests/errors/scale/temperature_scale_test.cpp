// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/scale/temperature_scale.hpp>
#include <type_traits>
#include <utility>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

namespace {
constexpr auto heating = [](double elapsed) { return 20 + elapsed / 2; };
}  // namespace

TEMPLATE_TEST_CASE("The reading and the bias in it scale with the temperature", "", float, double) {
  using Vector = Vector3<TestType>;
  const TemperatureScale term{PerAxis<TestType>(TestType(0.125), TestType(-0.25), 0), heating, TestType(30)};
  for (const auto& [elapsed, difference] : {std::pair(0, -10), std::pair(20, 0), std::pair(40, 10)}) {
    const auto sample =
        applied(term, sample_with<TestType>(Vector(8, 4, 3), Vector(16, -4, 6), static_cast<TestType>(elapsed)));
    const auto d = static_cast<TestType>(difference);
    CHECK(sample.value == Vector(8 + d, 4 - d, 3));
    CHECK(sample.bias == Vector(16 + 2 * d, -4 + d, 6));
  }
}

TEST_CASE("A scale acts on the bias before it and not on the one behind it") {
  const ErrorModel model{ConstantBias{1}, TemperatureScale{0.1, heating}, ConstantBias{1}};
  auto state = model.start(StreamKey(1));
  auto sample = sample_with<double>(Eigen::Vector3d(1, 2, 3));
  model.apply(sample, state);
  CHECK(sample.value == Eigen::Vector3d(2, 2.5, 3));  // −5 K from 25 °C
  CHECK(sample.bias == Eigen::Vector3d(1.5, 1.5, 1.5));
}

TEST_CASE("Coefficients in every form, with profiles of every kind") {
  STATIC_CHECK(std::is_same_v<decltype(TemperatureScale{0.1F, WarmUp{20.0F, 60.0F, 300.0F}}),
                              TemperatureScale<float, WarmUp<float>>>);
  STATIC_CHECK(
      std::is_same_v<decltype(TemperatureScale{1, WarmUp{20, 60, 300}, 20}), TemperatureScale<double, WarmUp<double>>>);
  CHECK(TemperatureScale{Eigen::Vector3d(1, 2, 3), heating}.coefficient[2] == 3);
  static constexpr ErrorModel model{TemperatureScale{0.25, WarmUp{20, 60, 300}, 30}};
  STATIC_CHECK(std::get<0>(model.terms()).coefficient[1] == 0.25);
}

TEST_CASE("A temperature scale that is none is refused") {
  CHECK_THROWS_WITH((TemperatureScale{-testing::infinity<double>, heating}),
                    "TemperatureScale: coefficient is -inf, expected a finite number");
  CHECK_THROWS_WITH((TemperatureScale{0.1, heating, testing::nan<double>}),
                    "TemperatureScale: reference temperature is nan, expected a finite number");
}

TEST_CASE("A temperature scale in words") {
  CHECK(describe(TemperatureScale{PerAxis<double>(1e-4, 2e-4, 0), heating, 20}, SensorKind::accel) ==
        "temperature scale: coefficient (0.0001 0.0002 0) 1/K, reference temperature 20 degC");
}
