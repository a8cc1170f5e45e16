// SPDX-License-Identifier: MIT
// A B-spline over control points on SO(3) x R^3 gives a pose, its velocity and its acceleration at any time.

#include <cmath>
#include <cstdio>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

using namespace splinertia;

int main() {
  constexpr double interval = 0.25, radius = 10, turn_rate = 0.5;  // s, m, rad/s

  // A control point every 0.25 s: a level circle, with the x axis of the body along the path.
  std::vector<SO3xR3<double>> points;
  for (int i = 0; i < 20; ++i) {
    const double yaw = turn_rate * interval * i;
    points.push_back({Sophus::SO3d::rotZ(yaw), {radius * std::sin(yaw), -radius * std::cos(yaw), 20}});
  }

  // Order 4 is the cubic. It is defined from the second control point to the last but one, and passes close to them.
  const Spline<SO3xR3<double>, 4> curve({.start = 0, .interval = interval}, points);
  std::printf("from %.2f s to %.2f s\n", curve.start(), curve.end());

  // at<D>(t) gives the value and D derivatives, and throws if t is out of range; evaluate<D>(t) does not look. Tangents
  // of SO3xR3 are [rotation in the body; translation in the world].
  std::puts("t [s]  position [m]            speed [m/s]  rate [rad/s]  acceleration [m/s^2]");
  for (const double t : {1.0, 2.5, 4.25}) {
    const auto m = curve.at<2>(t);
    const Eigen::Vector3d p = position(m.value);
    std::printf("%5.2f  %6.3f %6.3f %6.3f  %11.3f  %12.3f  %20.3f\n", t, p.x(), p.y(), p.z(), world_velocity(m).norm(),
                angular_velocity(m).norm(), m.acceleration.tail<3>().norm());
  }
}

// prints
// from 0.00 s to 4.25 s
// t [s]  position [m]            speed [m/s]  rate [rad/s]  acceleration [m/s^2]
//  1.00   5.836 -8.089 20.000        4.987         0.500                 2.497
//  2.50   9.783 -1.940 20.000        4.987         0.500                 2.497
//  4.25   7.760  6.265 20.000        4.987         0.500                 2.497
