// SPDX-License-Identifier: MIT
// A spline does not pass through its control points; interpolate() finds the one that passes through given values. This
// one is in the plane: R^n needs only Eigen.

#include <cstdio>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/fit/interpolate.hpp>
#include <vector>

using namespace splinertia;

int main() {
  const std::vector<Stamped<Eigen::Vector2d, double>> waypoints{
      {0, {0, 0}}, {2, {4, 0}}, {4, {6, 3}}, {6, {4, 6}}, {8, {0, 6}}};  // s, m

  // Uniform knots for evenly spaced waypoints, NonUniformKnots<double> for others. Natural ends: no acceleration there.
  using Curve = Spline<Eigen::Vector2d, 4>;
  const Curve curve = interpolate<Curve>(waypoints, {.condition = EndCondition::natural});

  std::printf("%zu waypoints, %zu control points\n", waypoints.size(), curve.control_points().size());
  std::puts("t [s]  x [m]  y [m]  speed [m/s]  acceleration [m/s^2]");
  for (int t = 0; t <= 8; ++t) {
    const auto m = curve.at<2>(t);
    std::printf("%5d  %5.2f  %5.2f  %11.3f  %20.3f\n", t, m.value.x(), m.value.y(), m.velocity.norm(),
                m.acceleration.norm());
  }
}

// prints
// 5 waypoints, 7 control points
// t [s]  x [m]  y [m]  speed [m/s]  acceleration [m/s^2]
//     0   0.00  -0.00        2.175                 0.000
//     1   2.11  -0.28        2.038                 0.602
//     2   4.00   0.00        1.871                 1.204
//     3   5.43   1.22        1.920                 1.025
//     4   6.00   3.00        1.875                 1.286
//     5   5.43   4.78        1.920                 1.025
//     6   4.00   6.00        1.871                 1.204
//     7   2.11   6.28        2.038                 0.602
//     8   0.00   6.00        2.175                 0.000
