// SPDX-License-Identifier: MIT
#include <splinertia/motion/ellipse.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"

using namespace splinertia;

TEST_CASE("The derivatives of the ellipse are those of its value") {
  const Ellipse<> ellipse;
  for (const double t : {-4.0, 0.0, 0.3, 11.0}) {
    for (const double error : testing::derivative_errors<2>(ellipse, t, 1e-3)) CHECK(error < 1e-9);
  }
}

TEST_CASE("The ellipse is the course simulators' one") {
  const Ellipse<> ellipse;
  const double pi = std::acos(-1.0);
  CHECK(ellipse.rate == pi / 10);
  const auto [R, p] = ellipse.evaluate<0>(5).value;  // a quarter of the way
  CHECK((p - Eigen::Vector3d(5, 25, 5 + std::sin(5 * pi))).norm() < 1e-14);
  const Eigen::Matrix3d expected = (Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(0.2 * std::sin(5), Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(0.1 * std::cos(5), Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  CHECK((R.matrix() - expected).norm() < 1e-15);
}

TEST_CASE("In float the ellipse is the same to float's accuracy") {
  const auto f = Ellipse<float>{}.evaluate<2>(3.0F);
  const auto d = Ellipse<double>{}.evaluate<2>(3.0);
  CHECK((f.acceleration.cast<double>() - d.acceleration).norm() < 2e-5);
}
