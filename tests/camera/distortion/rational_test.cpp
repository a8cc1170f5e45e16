// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/camera/distortion/rational.hpp>
#include <splinertia/camera/pinhole.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::message_of;

namespace {

template <typename Scalar>
using Model = Pinhole<Rational<Scalar>>;

}  // namespace

TEMPLATE_TEST_CASE("rational: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<Model, TestType>({{603.2, 603, 640.5, 359.2, 12.4, 7.1, -0.0001, 5e-05, 0.36, 12.7, 11.3, 1.95},
                                         {373, 372, 256, 486, -0.39, -0.033, 0, 0, 0.001, 0.01, 0.02, 0.001}});
}

TEMPLATE_TEST_CASE("rational: without a denominator it is the polynomial", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar k1(-0.28F), k2(0.07F), p1(2e-4F), p2(1e-4F), zero(0);
  const Rational<Scalar> rational(k1, k2, p1, p2, zero, zero, zero, zero);
  const RadialTangential<Scalar> polynomial(k1, k2, p1, p2);
  CHECK(rational.limit() == polynomial.limit());
  const auto a = rational.template distort<Wrt::point>(Scalar(0.5), Scalar(-0.25));
  const auto b = polynomial.template distort<Wrt::point>(Scalar(0.5), Scalar(-0.25));
  CHECK(a.x == b.x);
  CHECK(a.y == b.y);
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  CHECK((a.by_point - b.by_point).cwiseAbs().maxCoeff() <= 4 * eps);
}

TEST_CASE("rational: the domain ends where the radius turns back") {
  // r/(1 + s) turns at r = 1.
  const Rational<double> turn(0, 0, 0, 0, 0, 1, 0, 0);
  CHECK(std::abs(turn.limit() - 1) < 1e-15);
  CHECK(turn.distort<Wrt::nothing>(0.999, 0.0).valid);
  CHECK_FALSE(turn.distort<Wrt::nothing>(1.001, 0.0).valid);
  CHECK(turn.undistort(0.4999, 0));
  CHECK_FALSE(turn.undistort(0.5001, 0));
  CHECK(std::abs(Pinhole<Rational<double>>(1, 1, 0, 0, turn).largest_angle() - std::atan(1.0)) < 1e-15);
}

TEST_CASE("rational: the domain ends at a pole") {
  // r/(1 − s/4) grows up to r = 2.
  const Rational<double> pole(0, 0, 0, 0, 0, -0.25, 0, 0);
  CHECK(std::abs(pole.limit() - 2) < 1e-15);
  CHECK(pole.distort<Wrt::nothing>(1.999, 0.0).valid);
  CHECK_FALSE(pole.distort<Wrt::nothing>(2.001, 0.0).valid);
  const auto far = pole.undistort(1e6, 0);
  REQUIRE(far);
  CHECK(std::abs(far->x() - 2) < 1e-5);
}

TEST_CASE("rational: without turn and pole there is no limit") {
  const Rational<double> free(12.4, 7.1, 0, 0, 0.36, 12.7, 11.3, 1.95);
  CHECK(free.limit() == std::numeric_limits<double>::max());
  CHECK(free.distort<Wrt::nothing>(1e6, 1e6).valid);
  const auto distorted = free.distort<Wrt::nothing>(1e9, 2e9);
  const auto back = free.undistort(distorted.x, distorted.y);
  REQUIRE(back);
  CHECK(back->isApprox(Eigen::Vector2d(1e9, 2e9), 1e-14));
}

TEST_CASE("rational: parameters that are not finite are named") {
  const auto message = message_of([] { return Rational<double>(0, 0, 0, 0, 0, NAN, 0, 0); });
  CHECK(message == "Rational: coefficients[5] is nan, expected a finite number");
}
