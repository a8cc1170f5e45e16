// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/errors/per_axis.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

TEST_CASE("A parameter is one value for all axes or one for each") {
  constexpr PerAxis<double> all = 0.5;
  STATIC_CHECK(all[0] == 0.5);
  STATIC_CHECK(all[2] == 0.5);
  constexpr PerAxis<float> three(1, 2, 3);
  STATIC_CHECK(three[1] == 2);
  const PerAxis<double> each = Eigen::Vector3d(1, 2, 3);
  CHECK(each[0] == 1);
  CHECK(each[1] == 2);
  CHECK(each[2] == 3);
  CHECK(each.vector() == Eigen::Vector3d(1, 2, 3));
  const PerAxis<double> whole = 7, row = Eigen::RowVector3d(1, 2, 3), expression = 2 * Eigen::Vector3d(1, 2, 3);
  CHECK(whole[1] == 7);
  CHECK(row[2] == 3);
  CHECK(expression[2] == 6);
  double sum = 0;
  for (const double value : each) sum += value;
  CHECK(sum == 6);
  STATIC_CHECK(!std::is_constructible_v<PerAxis<double>, Eigen::Vector2d>);
  STATIC_CHECK(!std::is_constructible_v<PerAxis<double>, Eigen::VectorXd>);
}

TEST_CASE("A parameter tells the scalar of its term") {
  STATIC_CHECK(std::is_same_v<ScalarOfParameter<float>, float>);
  STATIC_CHECK(std::is_same_v<ScalarOfParameter<double>, double>);
  STATIC_CHECK(std::is_same_v<ScalarOfParameter<int>, double>);
  STATIC_CHECK(std::is_same_v<ScalarOfParameter<unsigned long>, double>);
  STATIC_CHECK(std::is_same_v<ScalarOfParameter<PerAxis<float>>, float>);
  STATIC_CHECK(std::is_same_v<ScalarOfParameter<Eigen::Vector3f>, float>);
  STATIC_CHECK(std::is_same_v<ScalarOfParameter<Eigen::Matrix3d>, double>);
}

TEST_CASE("A number is finite if it is neither infinite nor NaN") {
  STATIC_CHECK(is_finite(0.0));
  STATIC_CHECK(is_finite(std::numeric_limits<float>::max()));
  STATIC_CHECK(is_finite(std::numeric_limits<double>::lowest()));
  STATIC_CHECK(!is_finite(infinity));
  STATIC_CHECK(!is_finite(-infinity));
  STATIC_CHECK(!is_finite(not_a_number));
}

TEST_CASE("What must not be negative is refused with the name of term, parameter and value") {
  CHECK_THROWS_WITH(require_non_negative("WhiteNoise", "density", PerAxis<double>(-1)),
                    "WhiteNoise: density is -1, expected a finite number >= 0");
  CHECK_THROWS_WITH(require_non_negative("T", "p", PerAxis<double>(0, not_a_number, 0)),
                    "T: p is nan, expected a finite number >= 0");
  CHECK_THROWS_AS(require_non_negative("T", "p", std::numeric_limits<float>::infinity()), std::invalid_argument);
  CHECK_THROWS_AS(require_non_negative("T", "p", PerAxis<double>(0, 0, -1e-300)), std::invalid_argument);
  CHECK_NOTHROW(require_non_negative("T", "p", PerAxis<double>(0)));
  CHECK_NOTHROW(require_non_negative("T", "p", -0.0));
}

TEST_CASE("What must be positive is refused if it is zero") {
  CHECK_THROWS_WITH(require_positive("T", "p", 0.0), "T: p is 0, expected a finite number > 0");
  CHECK_THROWS_WITH(require_positive("T", "p", PerAxis<double>(1, 1, -2.5)),
                    "T: p is -2.5, expected a finite number > 0");
  CHECK_THROWS_WITH(require_positive("T", "p", PerAxis<double>(infinity, 1, 1)),
                    "T: p is inf, expected a finite number > 0");
  CHECK_THROWS_AS(require_positive("T", "p", not_a_number), std::invalid_argument);
  CHECK_NOTHROW(require_positive("T", "p", PerAxis<double>(std::numeric_limits<double>::denorm_min())));
}

TEST_CASE("What must be finite may be negative") {
  CHECK_THROWS_WITH(require_finite("T", "p", -infinity), "T: p is -inf, expected a finite number");
  CHECK_THROWS_WITH(require_finite("T", "p", PerAxis<double>(1, not_a_number, 1)),
                    "T: p is nan, expected a finite number");
  CHECK_NOTHROW(require_finite("T", "p", PerAxis<double>(-1)));
  Eigen::Matrix3<double> matrix = -Eigen::Matrix3<double>::Identity();
  CHECK_NOTHROW(require_finite("T", "p", matrix));
  matrix(2, 1) = infinity;
  CHECK_THROWS_WITH(require_finite("T", "p", matrix), "T: p is inf, expected a finite number");
}

TEST_CASE("A value is told to its last digit") {
  CHECK_THROWS_WITH(require(false, "T", "p", 0.1 + 0.2, "less"), "T: p is 0.30000000000000004, expected less");
}
