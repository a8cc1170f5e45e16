// SPDX-License-Identifier: MIT
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

TEST_CASE("A level IMU at rest reads gravity upwards") {
  const auto ideal = ideal_imu(at_rest(SO3xR3<double>{}).evaluate<2>(1.0));
  CHECK(ideal.gyro.isZero(0));
  CHECK(ideal.accel == Eigen::Vector3d(0, 0, 9.80665));
}

TEMPLATE_TEST_CASE("A falling IMU reads nothing, whichever the group", "", SO3xR3<double>, Sophus::SE3d) {
  Motion<TestType, 2> m;
  m.value = TestType{};
  m.velocity.setZero();
  m.acceleration.setZero();
  const Eigen::Vector3d gravity(0, 0, -9.81);
  if constexpr (SplitPose<TestType>) {
    m.acceleration.template tail<3>() = gravity;
  } else {
    m.acceleration.template head<3>() = gravity;
  }
  CHECK(ideal_imu(m, gravity).accel.isZero(0));
}

// An IMU on a lever arm must read what an IMU at its place reads: R R_BI, p + R p_BI, differentiated numerically.
TEMPLATE_TEST_CASE("A lever arm adds the Euler and centripetal terms and turns the axes", "", SO3xR3<double>,
                   Sophus::SE3d) {
  testing::Random random(1);
  const Spline<TestType, 6> curve({.start = 0, .interval = 0.5}, random.walk<TestType>(12));
  const Mounting arm{Sophus::SO3d::exp({0.4, -0.8, 1.1}), Eigen::Vector3d(0.3, -0.5, 0.2)};
  const Eigen::Vector3d gravity(0.1, 0.2, -9.8);
  const double t = 1.7, h = 1e-3;
  const auto m = curve.template evaluate<2>(t);
  const Sophus::SO3d R = rotation(m.value) * arm.R_BI;
  const auto imu_velocity = [&](double s) -> Eigen::Vector3d {
    const auto at = curve.template evaluate<1>(s);
    return world_velocity(at) + rotation(at.value) * angular_velocity(at).cross(arm.p_BI);
  };
  const auto imu_attitude = [&](double s) {
    return increment<Sophus::SO3d>(R, rotation(curve.template evaluate<0>(s).value) * arm.R_BI);
  };
  const auto acceleration = testing::central_difference<Eigen::Vector3d>(imu_velocity, t, h);
  const auto rate = testing::central_difference<Eigen::Vector3d>(imu_attitude, t, h);
  const auto reading = ideal_imu(m, gravity, arm);
  CHECK((reading.gyro - rate).norm() < 1e-10);
  CHECK((reading.accel - R.inverse() * Eigen::Vector3d(acceleration - gravity)).norm() < 1e-9);
}
