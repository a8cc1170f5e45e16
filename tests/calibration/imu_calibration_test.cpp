// SPDX-License-Identifier: MIT
#include <splinertia/calibration/imu_calibration.hpp>
#include <splinertia/motion/circle.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

ImuCalibration<double> some_calibration() {
  return {.gyro_bias = {0.01, -0.02, 0.03},
          .accel_bias = {0.1, -0.2, 0.3},
          .gravity = {0.4, -0.3, -9.8},
          .mounting = {Sophus::SO3d::exp({0.3, -1.2, 2.1}), {0.2, -0.1, 0.3}}};
}

}  // namespace

TEST_CASE("A perfect IMU is the default") {
  const auto m = Circle<>{.radius = 3, .rate = 2}.evaluate<2>(0.4);
  const auto ideal = ideal_imu(m);
  const auto reading = predicted_imu(m, {});
  CHECK(reading.gyro == ideal.gyro);
  CHECK(reading.accel == ideal.accel);
}

TEST_CASE("Biases come on top of what the IMU reads in its own axes, away from the body's origin") {
  // Going forward along a circle of 3 m, at 2 rad/s; the IMU is 0.5 m further in (the body's y is to the left) with its
  // x axis along the body's y.
  ImuCalibration<double> calibration;
  calibration.gyro_bias = {0.1, 0.2, 0.3};
  calibration.accel_bias = {-1, -2, -3};
  calibration.gravity = {0, 0, -10};
  calibration.mounting = {Sophus::SO3d::rotZ(std::acos(0.0)), {0, 0.5, 0}};
  const auto reading = predicted_imu(Circle<>{.radius = 3, .rate = 2}.evaluate<2>(0.4), calibration);
  CHECK((reading.gyro - Eigen::Vector3d(0.1, 0.2, 2.3)).norm() < 1e-14);
  CHECK((reading.accel - Eigen::Vector3d(2.5 * 4 - 1, -2, 10 - 3)).norm() < 1e-13);
}

TEMPLATE_TEST_CASE("The rate of what an IMU reads is that of differences in time", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  testing::Random random(5);
  // Of order 6: the third derivative of the curve is smooth within a segment.
  const Spline<G, 6> curve({.start = 0, .interval = 0.5}, random.walk<G>(8));
  const auto calibration = some_calibration();
  for (const double t : {0.2, 0.71, 1.25}) {
    INFO("t = " << t);
    const Vector6 rate = predicted_imu_rate(curve.template evaluate<3>(t), calibration);
    const auto read = [&](double time) {
      const auto [gyro, accel] = predicted_imu(curve.template evaluate<2>(time), calibration);
      Vector6 both;
      both << gyro, accel;
      return both;
    };
    const Vector6 difference = testing::central_difference<Vector6>(read, t, 2e-3);
    // h⁶/140 of a seventh derivative is 1e-13, if that is as large as 10⁶; rounding, 1e-14/h, is 1e-11.
    CHECK((rate.head<3>() - difference.head<3>()).norm() < 1e-10);
    CHECK((rate.tail<3>() - difference.tail<3>()).norm() < 1e-9);
    CHECK(rate.head<3>().norm() > 0.1);
    CHECK(rate.tail<3>().norm() > 1);
  }
}
