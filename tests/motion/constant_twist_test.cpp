// SPDX-License-Identifier: MIT
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/constant_twist.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

TEMPLATE_TEST_CASE("A constant twist moves by its exponential on any group", "", Eigen::Vector2d, Sophus::SO2d,
                   Sophus::SO3d, Sophus::SE2d, Sophus::SE3d, SO3xR3<double>) {
  testing::Random random(1);
  const ConstantTwist<TestType> motion{random.walk<TestType>(1)[0], random.tangent<TestType>()};
  for (const double t : {-2.0, 0.0, 3.0}) {
    for (const double error : testing::derivative_errors<3>(motion, t, 1e-2)) CHECK(error < 1e-11);
    CHECK(motion.template evaluate<3>(t).acceleration.isZero(0));
  }
}

TEST_CASE("A body at rest stays exactly where it is") {
  testing::Random random(2);
  const auto pose = random.walk<SO3xR3<double>>(1)[0];
  const auto m = at_rest(pose).evaluate<2>(12345.678);
  CHECK(increment(pose, m.value).isZero(0));
  CHECK(m.velocity.isZero(0));
  CHECK(m.acceleration.isZero(0));
}
