// SPDX-License-Identifier: MIT
// A curve in the plane through waypoints. A B-spline does not pass through its control points. The control points of a
// curve through given points solve a linear system, because a cubic is (P0 + 4 P1 + P2)/6 at its knots. R^n needs only
// Eigen, because this program has no rotations.

#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/exit_code.hpp"

#ifdef SOPHUS_COMMON_HPP
#error "a curve in R^n should not need Sophus"
#endif

using Curve = splinertia::Spline<Eigen::Vector2d, 4>;

namespace {

constexpr double interval = 2;  // s from waypoint to waypoint

/// The cubic that passes through the waypoints one after the other, with zero acceleration at both ends.
Curve through(const std::vector<Eigen::Vector2d>& waypoints) {
  const auto n = static_cast<Eigen::Index>(waypoints.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 2, n + 2);
  Eigen::MatrixX2d b = Eigen::MatrixX2d::Zero(n + 2, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    A.block<1, 3>(i, i) << 1, 4, 1;
    b.row(i) = 6 * waypoints[static_cast<std::size_t>(i)].transpose();
  }
  A.block<1, 3>(n, 0) << 1, -2, 1;  // the second derivative, at the first and the last waypoint
  A.block<1, 3>(n + 1, n - 1) << 1, -2, 1;
  const Eigen::MatrixX2d solution = A.partialPivLu().solve(b);
  std::vector<Eigen::Vector2d> control_points;
  for (const auto& point : solution.rowwise()) control_points.push_back(point.transpose());
  return {{.start = 0, .interval = interval}, control_points};
}

}  // namespace

int main() {
  return run_program("waypoints", [] {
    const std::vector<Eigen::Vector2d> waypoints{{0, 0}, {4, 0}, {6, 3}, {4, 6}, {0, 6}};
    const Curve curve = through(waypoints);
    std::printf("%zu waypoints, %zu control points, %.0f s\n", waypoints.size(), curve.control_points().size(),
                curve.end());
    std::printf("t [s]  position [m]       speed [m/s]  acceleration [m/s^2]\n");
    double largest = 0, nearest = 1e9;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      const auto m = curve.at<2>(interval * static_cast<double>(i));
      std::printf("%4.1f   %8.5f %8.5f  %11.4f  %20.4f\n", interval * static_cast<double>(i), m.value.x(), m.value.y(),
                  m.velocity.norm(), m.acceleration.norm());
      largest = std::max(largest, (m.value - waypoints[i]).norm());
      if (i > 0 && i + 1 < waypoints.size()) {
        nearest = std::min(nearest, (curve.control_points()[i + 1] - waypoints[i]).norm());
      }
    }
    std::printf("the curve is within %.0e m of its waypoints, its inner control points at least %.2f m from them\n",
                largest, nearest);
  });
}
