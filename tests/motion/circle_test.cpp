// SPDX-License-Identifier: MIT
#include <splinertia/motion/circle.hpp>
#include <splinertia/motion/kinematics.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"

using namespace splinertia;

TEST_CASE("The derivatives of the circle are those of its value") {
  const Circle<> circle{.radius = 3, .rate = -1.7, .height = 2};
  for (const double t : {-4.0, 0.0, 0.3, 11.0}) {
    for (const double error : testing::derivative_errors<2>(circle, t, 1e-3)) CHECK(error < 1e-10);
  }
}

TEST_CASE("On a circle the body's x axis is the direction of travel and the acceleration points to the centre") {
  const Circle<> circle{.radius = 2, .rate = 0.5, .height = 1};
  const auto m = circle.evaluate<2>(0.8);
  const Eigen::Vector3d forward = rotation(m.value).inverse() * world_velocity(m);
  CHECK((forward - Eigen::Vector3d(1, 0, 0)).norm() < 1e-15);
  const Eigen::Vector3d left = specific_force(m, Eigen::Vector3d(0, 0, 0));
  CHECK((left - Eigen::Vector3d(0, 0.5, 0)).norm() < 1e-15);
}
