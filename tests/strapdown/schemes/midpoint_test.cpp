// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/schemes/midpoint.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("The midpoint method converges with order 2") {
  CHECK_THAT(testing::observed_order<Midpoint>(100, 200), WithinAbs(2.0, 0.02));
  CHECK_THAT(testing::observed_order<Midpoint>(200, 800), WithinAbs(2.0, 0.02));
  testing::check_order<Midpoint>(2, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<Midpoint>(2);
}

TEST_CASE("On the ellipse at 200 Hz the midpoint method stays within a millimetre") {
  CHECK(testing::ellipse_error<Midpoint>(200) <= 1e-3);
}

TEST_CASE("In aggressive motion at 200 Hz the midpoint method stays within a metre") {
  CHECK(testing::aggressive_error<Midpoint>(testing::regular_stamps(200)) < 0.92);
}
