// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/camera/distortion/radial_tangential.hpp>
#include <splinertia/camera/pinhole.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;

namespace {

template <typename Scalar>
using Model = Pinhole<RadialTangential<Scalar>>;

}  // namespace

TEMPLATE_TEST_CASE("radial-tangential: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<Model, TestType>(
      {{458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05},
       {517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026},
       {460, 461, 320, 240, -0.3, 0, 0, 0}});
}

TEST_CASE("radial-tangential: the domain ends where the radius turns back") {
  // r − r³/3 turns at r = 1.
  const RadialTangential<double> turn(-1.0 / 3, 0, 0, 0);
  CHECK(std::abs(turn.limit() - 1) < 1e-15);
  CHECK(turn.distort<Wrt::nothing>(0.999, 0.0).valid);
  CHECK_FALSE(turn.distort<Wrt::nothing>(1.001, 0.0).valid);
  CHECK(turn.undistort(0.6666, 0));
  CHECK_FALSE(turn.undistort(0.6667, 0));
  CHECK(RadialTangential<double>(0.1, 0, 0, 0).limit() == std::numeric_limits<double>::max());
}

TEST_CASE("radial-tangential: parameters that are not finite are named") {
  const auto message = testing::message_of([] { return RadialTangential<double>(0, 0, 0, NAN); });
  CHECK(message == "RadialTangential: coefficients[3] is nan, expected a finite number");
}
