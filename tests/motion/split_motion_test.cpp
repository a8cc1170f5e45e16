// SPDX-License-Identifier: MIT
#include <splinertia/motion/split_motion.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("A rigid body's state becomes a motion with rotation before translation") {
  RigidBodyState<double> s;
  s.q_WB = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  s.p_WB << 1, 2, 3;
  s.omega << 4, 5, 6;
  s.v_WB << 7, 8, 9;
  s.alpha << 10, 11, 12;
  s.a_WB << 13, 14, 15;
  const auto m = split_motion<2>(s);
  CHECK(m.value.get<0>().unit_quaternion().coeffs() == s.q_WB.coeffs());
  CHECK(m.value.get<1>() == s.p_WB);
  CHECK(m.velocity == (Eigen::Matrix<double, 6, 1>() << 4, 5, 6, 7, 8, 9).finished());
  CHECK(m.acceleration == (Eigen::Matrix<double, 6, 1>() << 10, 11, 12, 13, 14, 15).finished());
}
