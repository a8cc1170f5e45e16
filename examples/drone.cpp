// SPDX-License-Identifier: MIT
// What an IMU on a drone would measure in a banked turn, along splines of order 4 and 6 on SO(3) x R^3. The orders
// differ in smoothness at knots: order 4 has jumps in the jerk, order 6 has none.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/exit_code.hpp"

using namespace splinertia;

namespace {

constexpr double radius = 10, speed = 5, interval = 0.25;  // m, m/s, s
constexpr double yaw_rate = speed / radius;

/// In a turn without slip the drone banks so that the specific force is along its z axis.
std::vector<SO3xR3<double>> banked_turn() {
  const double bank = std::atan2(speed * yaw_rate, 9.80665);
  std::vector<SO3xR3<double>> points;
  for (int i = 0; i < 40; ++i) {
    const double yaw = yaw_rate * interval * i;
    const Sophus::SO3d R_WB = Sophus::SO3d::rotZ(yaw) * Sophus::SO3d::rotX(-bank);
    points.push_back({R_WB, {radius * std::sin(yaw), -radius * std::cos(yaw), 20}});
  }
  return points;
}

/// The largest change of a quantity from the last floating-point time before a knot to the knot.
double largest_jump(const auto& curve, const auto& quantity) {
  double largest = 0;
  for (double knot = curve.start() + interval; knot < curve.end(); knot += interval) {
    const Eigen::Vector3d before = quantity(curve.template evaluate<3>(std::nextafter(knot, 0)));
    const Eigen::Vector3d after = quantity(curve.template evaluate<3>(knot));
    largest = std::max(largest, (after - before).norm());
  }
  return largest;
}

template <int Order>
void fly(const char* name) {
  const Spline<SO3xR3<double>, Order> curve({.start = 0, .interval = interval}, banked_turn());
  std::printf("%s (order %d), %.2f s\n", name, Order, curve.end() - curve.start());
  std::printf("  t [s]   gyro [rad/s]             accel [m/s^2]\n");
  for (const double t : {1.0, 3.5}) {
    const auto imu = ideal_imu(curve.template at<2>(t));
    std::printf("  %.2f   %7.4f %7.4f %7.4f   %8.4f %8.4f %8.4f\n", t, imu.gyro.x(), imu.gyro.y(), imu.gyro.z(),
                imu.accel.x(), imu.accel.y(), imu.accel.z());
  }
  const double force = largest_jump(curve, [](const auto& m) { return ideal_imu(m).accel; });
  const double jerk = largest_jump(curve, [](const auto& m) { return m.jerk.template tail<3>().eval(); });
  std::printf("  at its knots the specific force jumps by %.0e m/s^2, the jerk by %.0e m/s^3\n", force, jerk);
}

}  // namespace

int main() {
  return run_program("drone", [] {
    std::printf("A turn of radius %g m at %g m/s needs a specific force of %.4f m/s^2 along z\n", radius, speed,
                std::hypot(9.80665, speed * yaw_rate));
    fly<4>("cubic");
    fly<6>("quintic");
  });
}
