// SPDX-License-Identifier: MIT
#include <splinertia/motion/euler_angles.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {
EulerAngles<double> tumbling(double t) {
  return {.yaw = {std::sin(2 * t), 2 * std::cos(2 * t), -4 * std::sin(2 * t)},
          .pitch = {0.7 * std::cos(t), -0.7 * std::sin(t), -0.7 * std::cos(t)},
          .roll = {t * t, 2 * t, 2}};
}
}  // namespace

TEST_CASE("The quaternion is yaw, then pitch, then roll") {
  const auto e = tumbling(0.9);
  const Eigen::Quaterniond expected = Eigen::AngleAxisd(e.yaw.angle, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(e.pitch.angle, Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(e.roll.angle, Eigen::Vector3d::UnitX());
  CHECK(rotation_increment<double>(e.quaternion(), expected).norm() < 1e-15);
}

TEST_CASE("Body rates and their derivatives follow from the angles") {
  for (const double t : {-1.0, 0.0, 0.4, 2.0}) {
    const auto q = tumbling(t).quaternion();
    const auto omega = testing::central_difference<Eigen::Vector3d>(
        [&](double s) { return rotation_increment<double>(q, tumbling(s).quaternion()); }, t, 1e-3);
    const auto alpha =
        testing::central_difference<Eigen::Vector3d>([&](double s) { return tumbling(s).angular_velocity(); }, t, 1e-3);
    CHECK((tumbling(t).angular_velocity() - omega).norm() < 1e-11);
    CHECK((tumbling(t).angular_acceleration() - alpha).norm() < 1e-11);
  }
}
