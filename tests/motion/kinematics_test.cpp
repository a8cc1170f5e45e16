// SPDX-License-Identifier: MIT
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

// Whatever the group, velocity and force must be what position and attitude say.
TEMPLATE_TEST_CASE("Kinematics follow from the pose on both groups", "", SO3xR3<double>, Sophus::SE3d) {
  testing::Random random(3);
  const Spline<TestType, 5> curve({.start = 0, .interval = 0.5}, random.walk<TestType>(10));
  const double t = 1.3, h = 1e-3;
  const auto m = curve.template evaluate<2>(t);
  const auto p = [&](double s) -> Eigen::Vector3d { return position(curve.template evaluate<0>(s).value); };
  const auto v = [&](double s) { return world_velocity(curve.template evaluate<1>(s)); };
  const auto omega = [&](double s) { return angular_velocity(curve.template evaluate<1>(s)); };
  const auto phi = [&](double s) {
    return increment(rotation(m.value), rotation(curve.template evaluate<0>(s).value));
  };
  const auto a = testing::central_difference<Eigen::Vector3d>(v, t, h);
  CHECK((world_velocity(m) - testing::central_difference<Eigen::Vector3d>(p, t, h)).norm() < 1e-10);
  CHECK((angular_velocity(m) - testing::central_difference<Eigen::Vector3d>(phi, t, h)).norm() < 1e-10);
  CHECK((angular_acceleration(m) - testing::central_difference<Eigen::Vector3d>(omega, t, h)).norm() < 1e-10);
  const Eigen::Vector3d gravity(0.1, -0.2, -9.8);
  const Eigen::Vector3d force = rotation(m.value).inverse() * Eigen::Vector3d(a - gravity);
  CHECK((specific_force(m, gravity) - force).norm() < 1e-10);
}
