// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/scale/scale_factor.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("The reading is 1 + error times what it was, and so is the bias in it", "", float, double) {
  using Vector = Vector3<TestType>;
  const ScaleFactor term{PerAxis<TestType>(TestType(0.5), -2, 0)};
  const auto sample = applied(term, sample_with<TestType>(Vector(2, 3, 4), Vector(8, 5, 6)));
  CHECK(sample.value == Vector(3, -3, 4));
  CHECK(sample.bias == Vector(12, -5, 6));
}

TEST_CASE("A scale factor acts on the bias before it and not on the one behind it") {
  const ErrorModel model{ConstantBias{1}, ScaleFactor{0.5}, ConstantBias{PerAxis<double>(0, 1, 2)}};
  auto state = model.start(StreamKey(1));
  auto sample = sample_with<double>(Eigen::Vector3d(1, 2, 3));
  model.apply(sample, state);
  CHECK(sample.value == Eigen::Vector3d(3, 5.5, 8));
  CHECK(sample.bias == Eigen::Vector3d(1.5, 2.5, 3.5));
}

TEST_CASE("An error is given as a number, whole or not, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(ScaleFactor{0}), ScaleFactor<double>>);
  STATIC_CHECK(std::is_same_v<decltype(ScaleFactor{0.1F}), ScaleFactor<float>>);
  CHECK(ScaleFactor{Eigen::Vector3f(1, 2, 3)}.error[1] == 2.0F);
  constexpr ScaleFactor constant{PerAxis<double>(0.01, 0.02, 0.03)};
  STATIC_CHECK(constant.error[2] == 0.03);
}

TEST_CASE("An error that is none, or loses the signal, is refused") {
  CHECK_THROWS_WITH(ScaleFactor{-1}, "ScaleFactor: error is -1, expected a scale 1 + error other than 0");
  CHECK_THROWS_WITH((ScaleFactor{PerAxis<float>(0, -1, 0)}),
                    "ScaleFactor: error is -1, expected a scale 1 + error other than 0");
  CHECK_THROWS_WITH(ScaleFactor{testing::nan<double>}, "ScaleFactor: error is nan, expected a finite number");
  CHECK_THROWS_WITH(ScaleFactor{testing::infinity<double>}, "ScaleFactor: error is inf, expected a finite number");
  CHECK_NOTHROW(ScaleFactor{-2});  // an axis the wrong way round
}

TEST_CASE("A scale factor in words") {
  CHECK(describe(ScaleFactor{0.01}, SensorKind::gyro) == "scale factor: error 0.01");
  CHECK(describe(ScaleFactor{PerAxis<double>(0.01, 0, -0.5)}, SensorKind::accel) ==
        "scale factor: error (0.01 0 -0.5)");
}
