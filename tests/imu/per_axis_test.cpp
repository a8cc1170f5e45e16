// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/imu/per_axis.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("A parameter is one value for all axes or one for each") {
  constexpr PerAxis<double> all = 0.5;
  STATIC_CHECK(all[0] == 0.5);
  STATIC_CHECK(all[2] == 0.5);
  const PerAxis<double> each = Eigen::Vector3d(1, 2, 3);
  CHECK(each[0] == 1);
  CHECK(each[1] == 2);
  CHECK(each[2] == 3);
}

TEST_CASE("What must not be negative is refused with the name of term, parameter and value") {
  CHECK_THROWS_WITH(PerAxis<double>(-1).require_non_negative("WhiteNoise", "density"),
                    "WhiteNoise: density is -1, expected a finite number >= 0");
  CHECK_THROWS_AS(PerAxis<double>(0, std::nan(""), 0).require_non_negative("T", "p"), std::invalid_argument);
  CHECK_THROWS_AS(PerAxis<float>(std::numeric_limits<float>::infinity()).require_non_negative("T", "p"),
                  std::invalid_argument);
  CHECK_NOTHROW(PerAxis<double>(0).require_non_negative("T", "p"));
}
