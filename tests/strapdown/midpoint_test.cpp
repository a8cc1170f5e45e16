// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/midpoint.hpp>

#include "strapdown/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("The midpoint method converges with order 2") {
  CHECK_THAT(testing::observed_order<Midpoint>(100, 200), WithinAbs(2.0, 0.02));
  CHECK_THAT(testing::observed_order<Midpoint>(200, 800), WithinAbs(2.0, 0.02));
}

TEST_CASE("On the ellipse at 200 Hz the midpoint method stays within a millimetre") {
  CHECK(testing::ellipse_error<Midpoint>(200) <= 1e-3);
}
