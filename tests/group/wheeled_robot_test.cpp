// SPDX-License-Identifier: MIT
// A wheeled robot in the plane: wheels roll and do not slide, so the velocity in the robot's frame is (vx, 0, omega). If
// the control points obey this, a spline on SE(2) does so exactly where the commands are constant.
#include <algorithm>
#include <cmath>
#include <splinertia/group/sophus.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

constexpr double interval = 0.2, speed = 0.5, turn_rate = 0.8;  // s, m/s, rad/s

// 8 control points straight on, 16 in a turn, 8 straight on; each follows from the one before.
Spline<Sophus::SE2d, 4> drive() {
  using SE2 = GroupTraits<Sophus::SE2d>;
  std::vector<Sophus::SE2d> points{SE2::identity()};
  for (int i = 0; i < 32; ++i) {
    const Eigen::Vector3d twist(speed, 0, i < 8 || i >= 24 ? 0 : turn_rate);
    points.push_back(SE2::compose(points.back(), SE2::exp(twist * interval)));
  }
  return {{.start = 0, .interval = interval}, points};
}

}  // namespace

TEST_CASE("A wheeled robot slips only where its commands change") {
  const auto curve = drive();
  double slip = 0, slip_in_turn = 0;
  for (int i = 0; i <= 580; ++i) {
    const double t = 0.01 * i, sideways = std::abs(curve.at<1>(t).velocity[1]);
    slip = std::max(slip, sideways);
    if (t > 2 && t < 4) slip_in_turn = std::max(slip_in_turn, sideways);
  }
  CHECK(slip == Approx(0.0075).margin(0.0005));
  CHECK(slip_in_turn < 1e-13);
  CHECK((curve.at<1>(3.48).velocity - Eigen::Vector3d(speed, 0, turn_rate)).norm() < 1e-13);
}

TEST_CASE("16 steps of 0.2 s at 0.8 rad/s turn a wheeled robot by 2.56 rad") {
  CHECK(sizeof(Sophus::SE2d) == 32);
  CHECK(DofOf<Sophus::SE2d> == 3);
  const auto end = drive().at<1>(5.8);
  CHECK(end.value.so2().log() == Approx(2.56));
  CHECK((end.value.translation() - Eigen::Vector2d(0.642, 1.477)).norm() < 1e-3);
  CHECK((end.velocity - Eigen::Vector3d(speed, 0, 0)).norm() < 1e-13);
}
