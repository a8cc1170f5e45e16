// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/output/quantization.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("The reading becomes the nearest multiple of the bit; the bias does not change", "", float, double) {
  using Vector = Vector3<TestType>;
  const Quantization term{PerAxis<TestType>(1, TestType(0.5), 4)};
  const auto sample = applied(term, sample_with<TestType>(Vector(TestType(1.4), TestType(-1.3), 7), Vector(1, 2, 3)));
  CHECK(sample.value == Vector(1, TestType(-1.5), 8));
  CHECK(sample.bias == Vector(1, 2, 3));
  // Half a bit goes away from zero, either way.
  CHECK(applied(term, sample_with<TestType>(Vector(TestType(0.5), TestType(-0.25), 2))).value ==
        Vector(1, TestType(-0.5), 4));
}

TEST_CASE("It is off by half a bit at most, a whole number of bits, and stays as it is a second time") {
  const double bit = 35.0 / 32768;
  const Quantization term{bit};
  testing::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d value = 30 * Eigen::Vector3d(random.symmetric(), random.symmetric(), random.symmetric());
    const Eigen::Vector3d rounded = applied(term, sample_with<double>(value)).value;
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::abs(rounded[axis] - value[axis]) <= bit / 2 * (1 + 1e-9));
      CHECK(rounded[axis] == bit * std::round(rounded[axis] / bit));
    }
    CHECK(applied(term, sample_with<double>(rounded)).value == rounded);
  }
}

TEST_CASE("A bit below the value's own rounding changes nothing much, and never to infinity") {
  for (const double bit : {1e-300, 5e-324}) {
    const auto sample = applied(Quantization{bit}, sample_with<double>(Eigen::Vector3d(1e9, -3, 0)));
    CHECK(sample.value.allFinite());
    CHECK((sample.value - Eigen::Vector3d(1e9, -3, 0)).norm() < 1e-6);
  }
}

TEST_CASE("A bit is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(Quantization{1}), Quantization<double>>);
  STATIC_CHECK(std::is_same_v<decltype(Quantization{0.1F}), Quantization<float>>);
  CHECK(Quantization{Eigen::Vector3d(1, 2, 3)}.least_significant_bit[1] == 2);
  static constexpr ErrorModel model{Quantization{0.25}};
  STATIC_CHECK(std::get<0>(model.terms()).least_significant_bit[2] == 0.25);
}

TEST_CASE("A bit that is none is refused") {
  CHECK_THROWS_WITH(Quantization{0}, "Quantization: least significant bit is 0, expected a finite number > 0");
  CHECK_THROWS_WITH((Quantization{PerAxis<double>(1, -1, 1)}),
                    "Quantization: least significant bit is -1, expected a finite number > 0");
  CHECK_THROWS_AS(Quantization{testing::nan<double>}, std::invalid_argument);
  CHECK_THROWS_AS(Quantization{testing::infinity<float>}, std::invalid_argument);
}

TEST_CASE("A quantization in words") {
  CHECK(describe(Quantization{0.5}, SensorKind::gyro) == "quantization: least significant bit 0.5 rad/s");
  CHECK(describe(Quantization{0.5}, SensorKind::accel) == "quantization: least significant bit 0.5 m/s^2");
}
