// SPDX-License-Identifier: MIT
#include <numbers>
#include <splinertia/group/detail/planar_motion.hpp>
#include <splinertia/group/detail/rigid_motion.hpp>

#include "group/sophus_laws.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEMPLATE_TEST_CASE("SO(2) and SE(2) are Lie groups", "[group]", float, double, long double) {
  laws::hold_for<Sophus::SO2<TestType>>();
  laws::hold_for<Sophus::SE2<TestType>>();
}

TEMPLATE_TEST_CASE("a planar motion is a rigid motion in the plane", "[group]", float, double, long double) {
  using Scalar = TestType;
  const Scalar tolerance = 8 * std::numeric_limits<Scalar>::epsilon();  // two results of 3 eps, coefficients in common
  laws::Draws draw(41);
  for (const laws::Real angle : laws::angles()) {
    for (const double sign : {1.0, -1.0}) {
      const Scalar theta = static_cast<Scalar>(sign * angle);
      const Eigen::Vector2<Scalar> rho(static_cast<Scalar>(draw()), static_cast<Scalar>(draw()));
      const Eigen::Vector3<Scalar> rho3(rho.x(), rho.y(), 0), phi3(0, 0, theta);
      INFO("angle " << theta);
      const auto exp = planar_motion_exp<Scalar>(rho, theta);
      CHECK((exp.translation - rigid_motion_exp<Scalar>(rho3, phi3).translation.template head<2>()).norm() <=
            tolerance);
      CHECK(std::abs(exp.cosine - std::cos(theta)) <= tolerance / 2);
      CHECK(std::abs(exp.sine - std::sin(theta)) <= tolerance / 2 * std::abs(theta));
      CHECK((planar_motion_log<Scalar>(rho, theta) - rigid_motion_log<Scalar>(rho3, phi3).template head<2>()).norm() <=
            tolerance);
      // J_l of SE(3), rows and columns of x, y and the rotation about z.
      const auto expected = [&](const Eigen::Matrix3<Scalar>& diagonal, const Eigen::Matrix3<Scalar>& block) {
        Eigen::Matrix3<Scalar> m = diagonal;
        m.template topRightCorner<2, 1>() = block.template topRightCorner<2, 1>();
        return m;
      };
      CHECK((planar_motion_left_jacobian<Scalar>(rho, theta) -
             expected(rotation_left_jacobian<Scalar>(phi3), rigid_motion_left_jacobian<Scalar>(rho3, phi3).dual))
                .norm() <= tolerance);
      CHECK((planar_motion_left_jacobian_inverse<Scalar>(rho, theta) -
             expected(rotation_left_jacobian_inverse<Scalar>(phi3),
                      rigid_motion_left_jacobian_inverse<Scalar>(rho3, phi3).dual))
                .norm() <= tolerance);
    }
  }
}

TEST_CASE("half a turn along a half circle", "[group]") {
  const auto t = planar_motion_exp<double>({1, 0}, std::numbers::pi).translation;
  CHECK(t.isApprox(Eigen::Vector2d(0, 2 / std::numbers::pi), 1e-15));
  CHECK(quarter_turn<double>({1, 2}) == Eigen::Vector2d(-2, 1));
}

TEMPLATE_TEST_CASE("planar increments are relative to themselves", "[group]", float, double, long double) {
  using Scalar = TestType;
  using G = Sophus::SE2<Scalar>;
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  // As in rotation_test.cpp: z (1 + i δ) is exact for a z of 6 bits, and log is atan δ.
  laws::Draws draw(42);
  const Scalar unit = std::ldexp(Scalar(1), -(std::numeric_limits<Scalar>::digits - 8));
  for (int i = 0; i < 200; ++i) {
    const Scalar a = static_cast<Scalar>(std::round(draw() * 63) / 64),
                 b = static_cast<Scalar>(std::round(draw() * 63) / 64);
    const Scalar delta = static_cast<Scalar>(std::round(draw() * 3)) * unit;
    if (std::hypot(a, b) < Scalar(0.1)) continue;
    const auto x = rotation_from_unit_complex<Scalar>(a, b),
               y = rotation_from_unit_complex<Scalar>(a - b * delta, b + a * delta);
    CHECK(std::abs(increment<Sophus::SO2<Scalar>>(x, y)[0] - std::atan(delta)) <= 4 * eps * std::abs(delta));
  }
  // Positions of 2^20 m and a step of 2^−3 m with no rotation.
  G x = GroupTraits<G>::exp({0, 0, Scalar(0.5)});
  x.translation() << Scalar(1 << 20), Scalar(-(1 << 20));
  G y = x;
  y.translation().x() += Scalar(0.125);
  const Eigen::Vector3<Scalar> d = increment<G>(x, y);
  CHECK(std::abs(d[0] - std::cos(Scalar(0.5)) / 8) <= eps);
  CHECK(std::abs(d[1] + std::sin(Scalar(0.5)) / 8) <= eps);
  CHECK(d[2] == 0);
}
