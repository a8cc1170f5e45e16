// SPDX-License-Identifier: MIT
// A wheeled robot in the plane, without an IMU: SE(2) has half the numbers of a pose in space, and no quaternion. For a
// robot with an IMU use SO3xR3 (docs/splines.md). Wheels roll and do not slide, so the velocity in the robot's frame is
// (vx, 0, omega). If the control points obey this, the spline does so to a few per cent where the commands change, and
// exactly where they do not.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <splinertia/group/sophus.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/exit_code.hpp"

using splinertia::GroupTraits;
using splinertia::Spline;

using Curve = Spline<Sophus::SE2d, 4>;

namespace {

struct Command {
  double speed, turn_rate;  // m/s, rad/s
  int steps;
};

constexpr double interval = 0.2, wheel_distance = 0.4;  // s, m

/// Each control point follows from the previous one by driving for one interval: X exp(twist * interval).
std::vector<Sophus::SE2d> drive(const std::vector<Command>& commands) {
  using SE2 = GroupTraits<Sophus::SE2d>;
  std::vector<Sophus::SE2d> points{SE2::identity()};
  for (const auto& [speed, turn_rate, steps] : commands) {
    const Eigen::Vector3d twist(speed, 0, turn_rate);
    for (int i = 0; i < steps; ++i) points.push_back(SE2::compose(points.back(), SE2::exp(twist * interval)));
  }
  return points;
}

}  // namespace

int main() {
  return run_program("wheeled_robot", [] {
    const Curve curve({.start = 0, .interval = interval}, drive({{0.5, 0, 8}, {0.5, 0.8, 16}, {0.5, 0, 8}}));
    std::printf("A control point is %zu bytes, %d degrees of freedom\n\n", sizeof(Sophus::SE2d),
                splinertia::DofOf<Sophus::SE2d>);

    std::printf("t [s]   x [m]   y [m]  heading [deg]   vx [m/s]   vy [m/s]  omega [rad/s]   wheels [m/s]\n");
    double slip = 0, slip_in_turn = 0;
    for (int i = 0; i <= 580; ++i) {
      const double t = 0.01 * i;
      const auto m = curve.at<1>(t);
      const double vx = m.velocity[0], vy = m.velocity[1], omega = m.velocity[2];
      slip = std::max(slip, std::abs(vy));
      if (t > 2 && t < 4) slip_in_turn = std::max(slip_in_turn, std::abs(vy));
      if (i % 116 == 0) {
        const auto& p = m.value.translation();
        std::printf("%5.2f  %6.3f  %6.3f  %13.1f  %9.4f  %9.4f  %13.4f   %.3f %.3f\n", t, p.x(), p.y(),
                    m.value.so2().log() * 180 / 3.14159265358979323846, vx, vy, omega, vx - omega * wheel_distance / 2,
                    vx + omega * wheel_distance / 2);
      }
    }
    std::printf("\nsideways velocity at most %.4f m/s where the turn begins and ends, %.0e m/s within it\n", slip,
                slip_in_turn);
  });
}
