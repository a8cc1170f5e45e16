// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/nav_state.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("The state of a motion is its pose and world velocity") {
  const auto m = Ellipse<>{}.evaluate<1>(2.0);
  const NavState<double> state = nav_state(m, 2.0);
  CHECK(state.p_WB == position(m.value));
  CHECK(state.v_WB == world_velocity(m));
  CHECK(state.R_WB.unit_quaternion().coeffs() == rotation(m.value).unit_quaternion().coeffs());
  CHECK(state.time == 2.0);
}

TEST_CASE("Millions of small rotations leave the quaternion a unit one") {
  Sophus::SO3d R;
  const Eigen::Vector3d step(1e-3, -2e-3, 3e-3);
  constexpr int n = 1'000'000;
  for (int i = 0; i < n; ++i) R = advance_attitude<double>(R, step);
  CHECK(std::abs(R.unit_quaternion().norm() - 1) < 4e-16);
  // Every step is rounded alike, so that its relative error, up to 4 eps, is that of the whole turn of 3742 rad.
  const double angle_error = increment(GroupTraits<Sophus::SO3d>::exp(step * n), R).norm();
  CHECK(angle_error < 4 * std::numeric_limits<double>::epsilon() * step.norm() * n);
}
