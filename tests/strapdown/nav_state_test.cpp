// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/nav_state.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEST_CASE("The state of a motion is its pose and world velocity") {
  const auto m = Ellipse<>{}.evaluate<1>(2.0);
  const NavState<double> state = nav_state(m, 2.0);
  CHECK(state.p_WB == position(m.value));
  CHECK(state.v_WB == world_velocity(m));
  CHECK(state.R_WB.unit_quaternion().coeffs() == rotation(m.value).unit_quaternion().coeffs());
  CHECK(state.time == 2.0);
}

TEST_CASE("The state of a mounted IMU moves with the body") {
  const Ellipse<> motion;
  const Mounting mounting{Sophus::SO3d::exp({0.4, -0.8, 1.1}), Eigen::Vector3d(0.3, -0.5, 0.2)};
  const auto imu_position = [&](double t) {
    const auto body = motion.evaluate<0>(t).value;
    return Eigen::Vector3d(position(body) + rotation(body) * mounting.p_BI);
  };
  const NavState<> state = nav_state(motion.evaluate<1>(2.0), 2.0, mounting);
  const double h = 1e-5;
  CHECK((state.p_WB - imu_position(2.0)).norm() < 1e-14);
  CHECK((state.v_WB - (imu_position(2 + h) - imu_position(2 - h)) / (2 * h)).norm() < 1e-8);
  CHECK(increment(state.R_WB, rotation(motion.evaluate<0>(2.0).value) * mounting.R_BI).norm() < 1e-15);
  const Stamped<SO3xR3<double>, double> pose = stamped_pose(state);
  CHECK(pose.time == 2.0);
  CHECK(position(pose.value) == state.p_WB);
}

TEMPLATE_TEST_CASE("Millions of small rotations leave the quaternion a unit one", "", float, double) {
  using Scalar = TestType;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  Sophus::SO3<Scalar> R;
  const Eigen::Vector3<Scalar> step(Scalar(1e-3), Scalar(-2e-3), Scalar(3e-3));
  const auto r = rotation_exp<Scalar>(step);
  constexpr int n = 1'000'000;
  for (int i = 0; i < n; ++i) R = advance_attitude<Scalar>(R.unit_quaternion(), r);
  CHECK(std::abs(R.unit_quaternion().norm() - 1) < 2 * eps);
  // Every step is rounded alike, so that its error, up to eps/2, adds up.
  const auto truth = rotation_exp<long double>(step.template cast<long double>() * n);
  const auto got = R.unit_quaternion().template cast<long double>();
  CHECK((truth.conjugate() * got).vec().norm() < n * static_cast<long double>(eps));
}

TEST_CASE("Free fall is a parabola, also far from the origin") {
  const Eigen::Vector3d gravity(0, 0, -10);
  NavState<double> state{{}, {1, 2, 3}, {1e9, -1e9, 1e9}, 0};
  const NavIncrement<double> nothing{Eigen::Quaterniond::Identity(), {0, 0, 0}, {0, 0, 0}, 1.0 / 128};
  for (int i = 1; i <= 1280; ++i) state = InertialFrame{}.advance(state, nothing, gravity, i / 128.0);
  CHECK(state.time == 10);
  CHECK((state.v_WB - Eigen::Vector3d(1, 2, -97)).norm() < 1e-12);
  // Each step rounds to half of 2^-23 m, and may do so to the same side.
  CHECK((state.p_WB - Eigen::Vector3d(1e9 + 10, -1e9 + 20, 1e9 - 470)).norm() < 1280 * 1.2e-7);
}
