// SPDX-License-Identifier: MIT
// The readings of an IMU in a banked turn, along splines of order 4 and 6 over the same control points.
#include <algorithm>
#include <cmath>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

constexpr double radius = 10, speed = 5, interval = 0.25;  // m, m/s, s
constexpr double yaw_rate = speed / radius;

// In a turn without slip a drone banks so that the specific force is along its z axis.
template <int Order>
Spline<SO3xR3<double>, Order> banked_turn() {
  const double bank = std::atan2(speed * yaw_rate, 9.80665);
  std::vector<SO3xR3<double>> points;
  for (int i = 0; i < 40; ++i) {
    const double yaw = yaw_rate * interval * i;
    const Sophus::SO3d R_WB = Sophus::SO3d::rotZ(yaw) * Sophus::SO3d::rotX(-bank);
    points.push_back({R_WB, {radius * std::sin(yaw), -radius * std::cos(yaw), 20}});
  }
  return {{.start = 0, .interval = interval}, points};
}

// The largest change of a quantity from the last floating-point time before a knot to the knot.
double largest_jump(const auto& curve, const auto& quantity) {
  double largest = 0;
  for (double knot = curve.start() + interval; knot < curve.end(); knot += interval) {
    const Eigen::Vector3d before = quantity(curve.template evaluate<3>(std::nextafter(knot, 0)));
    const Eigen::Vector3d after = quantity(curve.template evaluate<3>(knot));
    largest = std::max(largest, (after - before).norm());
  }
  return largest;
}

double jump_of_force(const auto& curve) {
  return largest_jump(curve, [](const auto& m) { return ideal_imu(m).accel; });
}
double jump_of_jerk(const auto& curve) {
  return largest_jump(curve, [](const auto& m) { return m.jerk.template tail<3>().eval(); });
}

}  // namespace

TEST_CASE("In a banked turn the specific force is along z, but for what smoothing leaves") {
  const auto curve = banked_turn<4>();
  CHECK(curve.end() - curve.start() == Approx(9.25));
  for (const double t : {1.0, 3.5}) {
    const auto imu = ideal_imu(curve.at<2>(t));
    // The yaw rate of 0.5 rad/s is shared by y and z: sin and cos of the bank, 0.2496 rad.
    CHECK((imu.gyro - Eigen::Vector3d(0, -0.1235, 0.4845)).norm() < 1e-4);
    CHECK((imu.accel - Eigen::Vector3d(0, -0.0032, 10.1195)).norm() < 1e-4);
    CHECK(imu.accel.z() == Approx(std::hypot(9.80665, speed * yaw_rate)).epsilon(1e-3));
  }
}

TEST_CASE("The jerk of a cubic jumps at knots, that of a quintic does not, and the specific force of neither") {
  CHECK(jump_of_force(banked_turn<4>()) < 1e-12);
  CHECK(jump_of_force(banked_turn<6>()) < 1e-12);
  CHECK(jump_of_jerk(banked_turn<4>()) == Approx(0.16).epsilon(0.1));
  CHECK(jump_of_jerk(banked_turn<6>()) < 1e-11);
}
