// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
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

TEMPLATE_TEST_CASE("a blend of length and depth does not cancel behind", "", float, double) {
  using Scalar = TestType;
  using L = long double;
  const L eps = static_cast<L>(std::numeric_limits<Scalar>::epsilon());
  for (const Scalar a : {Scalar(0), Scalar(0.5), Scalar(1)}) {
    const Scalar b = a == 1 ? Scalar(1) : Scalar(1) - a;
    for (int i = 1; i < 180; ++i) {
      const auto x = static_cast<Scalar>(std::sin(L(i) / 57.3L)), z = static_cast<Scalar>(std::cos(L(i) / 57.3L));
      const Scalar square = x * x, length = std::sqrt(square + z * z);
      const BlendedLength<Scalar> blend(a, b, square, z, length);
      const L s = static_cast<L>(x) * static_cast<L>(x), h = std::sqrt(s + static_cast<L>(z) * static_cast<L>(z));
      const L plus = z < 0 ? s / (h - static_cast<L>(z)) : h + static_cast<L>(z), la = a, lb = b;
      const L value = la * plus + (lb - la) * static_cast<L>(z), slope = la * plus / h + (lb - la);
      CHECK(std::abs(static_cast<L>(blend.value) - value) <= 6 * eps * std::abs(value));
      CHECK(std::abs(static_cast<L>(blend.slope) - slope) <= 6 * eps * std::abs(slope));
    }
  }
}
