// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/camera/detail/blended_projection.hpp>

#include "support/catch.hpp"

using namespace splinertia::detail;

TEST_CASE("a blended projection and its inverse") {
  for (const double alpha : {0.0, 0.3, 0.5, 0.8, 1.0}) {
    for (const double beta : {0.5, 1.0, 2.0}) {
      for (double theta = 0; theta < 3; theta += 0.05) {
        const double x = std::sin(theta), z = std::cos(theta), rho = std::sqrt(beta * x * x + z * z);
        if (!(z > -blend_border(alpha) * rho + 1e-9)) continue;
        const auto ray = unblend(0.0, x / (alpha * rho + (1 - alpha) * z), alpha, beta);
        REQUIRE(ray);
        CHECK(std::abs(std::atan2(ray->y(), ray->z()) - theta) < 1e-9);
        CHECK(std::abs(blend_slope(alpha, beta * x * x, z) - (alpha * z / rho + 1 - alpha)) < 1e-15);
      }
    }
  }
  CHECK_FALSE(unblend(0.8, 0.8, 1.0, 1.0));  // outside the unit circle
}

TEST_CASE("length − z keeps its digits in front and behind") {
  CHECK(difference_of_length(1e-20, 1.0, 1.0) == 5e-21);
  CHECK(difference_of_length(16.0, -3.0, 5.0) == 8);
  CHECK(difference_of_length(16.0, 3.0, 5.0) == 2);
}
