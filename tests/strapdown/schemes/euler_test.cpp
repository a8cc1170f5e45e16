// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/schemes/euler.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("Euler's method converges with order 1") {
  CHECK_THAT(testing::observed_order<Euler>(100, 200), WithinAbs(1.0, 0.02));
  CHECK_THAT(testing::observed_order<Euler>(200, 800), WithinAbs(1.0, 0.02));
  testing::check_order<Euler>(1, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<Euler>(1);
}

TEST_CASE("On the ellipse at 200 Hz Euler's method is off by 0.39 m") {
  CHECK_THAT(testing::ellipse_error<Euler>(200), WithinAbs(0.392, 0.001));  // the course simulator's figure
}

TEST_CASE("In aggressive motion at 200 Hz Euler's method is off by 11 m") {
  CHECK_THAT(testing::aggressive_error<Euler>(testing::regular_stamps(200)), WithinAbs(11.35, 0.05));
}
