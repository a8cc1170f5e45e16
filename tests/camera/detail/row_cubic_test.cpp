// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/camera/detail/row_cubic.hpp>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using splinertia::detail::HermiteCubic;

TEMPLATE_TEST_CASE("A cubic has the given values and slopes at its ends", "", float, double, long double) {
  using Scalar = TestType;
  const HermiteCubic<Scalar> cubic(2, -3, 5, 7);
  CHECK(cubic.value(0) == 2);
  CHECK(cubic.slope(0) == -3);
  CHECK(cubic.value(1) == 5);
  CHECK(cubic.slope(1) == 7);
}

TEST_CASE("The extrema of a cubic are where its slope is zero") {
  splinertia::testing::Random random(1);
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    const HermiteCubic<double> cubic(random.symmetric(), 4 * random.symmetric(), random.symmetric(),
                                     4 * random.symmetric());
    const auto extrema = cubic.extrema();
    int changes = 0;
    for (int k = 0; k < 1000; ++k) changes += (cubic.slope(k * 1e-3) < 0) != (cubic.slope((k + 1) * 1e-3) < 0);
    if (changes == 0) {
      // Only a slope that is nearly zero.
      for (std::size_t k = 0; k < extrema.count; ++k) {
        CHECK(std::abs(cubic.slope(extrema.x[k])) < std::max(std::abs(cubic.slope(0)), std::abs(cubic.slope(1))) / 9);
      }
      continue;
    }
    REQUIRE(static_cast<int>(extrema.count) == changes);
    for (std::size_t k = 0; k < extrema.count; ++k) CHECK(std::abs(cubic.slope(extrema.x[k])) < 1e-13);
    if (changes == 2) CHECK(extrema.x[0] < extrema.x[1]);
    found += changes;
  }
  CHECK(found > 100);
  CHECK(HermiteCubic<double>(0, 1, 1, 1).extrema().count == 0);    // a line
  CHECK(HermiteCubic<double>(0, -1, 0, 1).extrema().x[0] == 0.5);  // a parabola
  CHECK(HermiteCubic<double>(-0.5, 0.751, 0.5, 0.751).extrema().count == 0);
  CHECK(HermiteCubic<double>(-0.5, 3.01, 0.5, 3.01).extrema().count == 2);
  CHECK(HermiteCubic<double>(-0.5, 3, 0.5, 3).extrema().count == 1);  // flat in the middle
}

TEST_CASE("The root of a nearly linear cubic is found to its digits") {
  splinertia::testing::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double rise = 1 + 0.1 * random.symmetric(), at = 0.5 + 0.49 * random.symmetric();
    const double before = -at * rise, after = (1 - at) * rise;
    const HermiteCubic<double> cubic(before, rise + 0.05 * random.symmetric(), after, rise + 0.05 * random.symmetric());
    const double x = cubic.root();
    CHECK((x >= 0 && x <= 1));
    CHECK(std::abs(cubic.value(x)) < 1e-12);
  }
}

TEST_CASE("The curvature bounds the second derivative") {
  const HermiteCubic<double> cubic(1, 2, -1, 3);
  for (double x = 0; x <= 1; x += 0.125) {
    CHECK(std::abs(2 * cubic.c2 + 6 * cubic.c3 * x) <= cubic.curvature());
  }
}
