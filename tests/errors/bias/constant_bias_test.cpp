// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("A constant bias is added to the reading and to the bias in it", "", float, double) {
  using Vector = Vector3<TestType>;
  const ConstantBias term{PerAxis<TestType>(1, -2, TestType(0.5))};
  STATIC_CHECK(std::is_same_v<decltype(term), const ConstantBias<TestType, 3>>);
  for (const TestType& elapsed : {TestType(0), TestType(1), TestType(1000)}) {
    const auto sample = applied(term, sample_with<TestType>(Vector(1, 2, 3), Vector(4, 5, 6), elapsed));
    CHECK(sample.value == Vector(2, 0, TestType(3.5)));
    CHECK(sample.bias == Vector(5, 3, TestType(6.5)));
  }
}

TEST_CASE("A bias is given as a number, whole or not, one for each axis, or a vector") {
  const int whole = 3;
  CHECK(ConstantBias{whole}.bias[2] == 3.0);
  STATIC_CHECK(std::is_same_v<decltype(ConstantBias{whole}), ConstantBias<double>>);
  STATIC_CHECK(std::is_same_v<decltype(ConstantBias{0.1}), ConstantBias<double>>);
  STATIC_CHECK(std::is_same_v<decltype(ConstantBias{0.1F}), ConstantBias<float>>);
  STATIC_CHECK(std::is_same_v<decltype(ConstantBias{0.1L}), ConstantBias<long double>>);
  STATIC_CHECK(std::is_same_v<decltype(ConstantBias{PerAxis<float>(1, 2, 3)}), ConstantBias<float, 3>>);
  CHECK(ConstantBias{Eigen::Vector3d(1, 2, 3)}.bias[1] == 2);
  CHECK(ConstantBias{Eigen::RowVector3f(1, 2, 3)}.bias[2] == 3.0F);
  CHECK(ConstantBias{2 * Eigen::Vector3d::UnitX()}.bias[0] == 2);
}

TEST_CASE("It can be made while compiling, and has no state") {
  static constexpr ErrorModel model{ConstantBias{-0.25}, ConstantBias{PerAxis<double>(1, 2, 3)}};
  STATIC_CHECK(std::get<0>(model.terms()).bias[1] == -0.25);
  STATIC_CHECK(std::is_empty_v<ConstantBias<>::State>);
  auto state = model.start(StreamKey(1));
  auto sample = sample_with<double>(Eigen::Vector3d::Zero());
  model.apply(sample, state);
  CHECK(sample.value == Eigen::Vector3d(0.75, 1.75, 2.75));
}

TEST_CASE("A bias that is not finite is refused") {
  CHECK_THROWS_WITH(ConstantBias{testing::nan<double>}, "ConstantBias: bias is nan, expected a finite number");
  CHECK_THROWS_WITH((ConstantBias{PerAxis<double>(0, 0, -testing::infinity<double>)}),
                    "ConstantBias: bias is -inf, expected a finite number");
  CHECK_THROWS_AS(ConstantBias{testing::infinity<float>}, std::invalid_argument);
}

TEST_CASE("A constant bias in words") {
  CHECK(describe(ConstantBias{0.1}, SensorKind::gyro) == "constant bias: bias 0.1 rad/s");
  CHECK(describe(ConstantBias{PerAxis<float>(0.1F, 2, 3)}, SensorKind::accel) == "constant bias: bias (0.1 2 3) m/s^2");
}
