// SPDX-License-Identifier: MIT
#include <splinertia/motion/coning.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"

using namespace splinertia;

TEST_CASE("The derivatives of coning are those of its value") {
  const Coning<> coning{.angle = 0.4, .rate = 5};
  for (const double t : {-4.0, 0.0, 0.3, 11.0}) {
    for (const double error : testing::derivative_errors<2>(coning, t, 1e-3)) CHECK(error < 1e-9);
  }
}

TEST_CASE("Coning keeps the body's z axis at its angle to the world's") {
  const Coning<> coning{.angle = 0.4, .rate = 5};
  for (const double t : {0.0, 0.1, 1.0}) {
    const Eigen::Vector3d z = coning.evaluate<0>(t).value.get<0>() * Eigen::Vector3d::UnitZ();
    CHECK_THAT(z.z(), WithinAbs(std::cos(0.4), 1e-15));
  }
}
