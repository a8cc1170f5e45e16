// SPDX-License-Identifier: MIT
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

TEMPLATE_TEST_CASE("The reading is clipped to its range; the bias does not change", "", float, double) {
  using Vector = Vector3<TestType>;
  const Saturation term{PerAxis<TestType>(1, 2, 3)};
  CHECK(applied(term, sample_with<TestType>(Vector(5, -5, 2))).value == Vector(1, -2, 2));
  CHECK(applied(term, sample_with<TestType>(Vector(-1, 2, -3))).value == Vector(-1, 2, -3));
  CHECK(applied(term, sample_with<TestType>(Vector(5, 5, 5), Vector(4, 5, 6))).bias == Vector(4, 5, 6));
}

TEST_CASE("A limit is given as a number, one for each axis, or a vector") {
  STATIC_CHECK(std::is_same_v<decltype(Saturation{35}), Saturation<double>>);
  STATIC_CHECK(std::is_same_v<decltype(Saturation{0.1F}), Saturation<float>>);
  CHECK(Saturation{Eigen::Vector3d(1, 2, 3)}.limit[1] == 2);
}

TEST_CASE("A limit that is none is refused") {
  CHECK_THROWS_WITH(Saturation{0}, "Saturation: limit is 0, expected a finite number > 0");
  CHECK_THROWS_WITH((Saturation{PerAxis<double>(1, 1, -2)}), "Saturation: limit is -2, expected a finite number > 0");
  CHECK_THROWS_AS(Saturation{testing::nan<double>}, std::invalid_argument);
  CHECK_THROWS_AS(Saturation{testing::infinity<double>}, std::invalid_argument);
}

TEST_CASE("A range of less than one bit is refused, on any axis and in either order") {
  const Saturation saturation{PerAxis<double>(1, 0.5, 1)};
  const Quantization coarse{0.75};
  const char* const text =
      "Saturation: limit is 0.5, expected at least the least significant bit of the Quantization term";
  CHECK_THROWS_WITH((ErrorModel{saturation, coarse}), text);
  CHECK_THROWS_WITH((ErrorModel{coarse, saturation}), text);
  CHECK_THROWS_WITH((ErrorModel{coarse}.with(saturation)), text);
  CHECK_NOTHROW(ErrorModel{Quantization{0.5}, saturation});
  static constexpr ErrorModel model{Quantization{0.5}, Saturation{0.5}};
  STATIC_CHECK(std::get<1>(model.terms()).limit[0] == 0.5);
}

TEST_CASE("A saturation in words") {
  CHECK(describe(Saturation{35}, SensorKind::gyro) == "saturation: limit 35 rad/s");
  CHECK(describe(Saturation{PerAxis<double>(1, 2, 3)}, SensorKind::accel) == "saturation: limit (1 2 3) m/s^2");
}
