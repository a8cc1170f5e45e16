// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/camera/distortion/equidistant.hpp>
#include <splinertia/camera/pinhole.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;

namespace {

template <typename Scalar>
using Model = Pinhole<Equidistant<Scalar>>;

}  // namespace

TEMPLATE_TEST_CASE("equidistant: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<Model, TestType>({{190.978, 190.973, 254.93, 256.897, 0.00348, 0.000715, -0.00205, 0.000203},
                                         {179.4, 178.5, 392.4, 597.8, -0.2724, 0.00188, -0.00051, 0.0000416},
                                         {862.95, 867.8, 518.8, 497.1, -0.0259, 0.00525, -0.00076, 0.000335},
                                         {300, 310, 320, 240, 0, 0, 0, 0}});
}

TEST_CASE("equidistant: the domain ends where the radius turns back") {
  // θ − θ³/3 turns at θ = 1.
  const Pinhole<Equidistant<double>> turn(1, 1, 0, 0, {-1.0 / 3, 0, 0, 0});
  CHECK(std::abs(turn.largest_angle() - 1) < 1e-15);
  CHECK(turn.project(testing::at_angle(0.999, 1.0)));
  CHECK_FALSE(turn.project(testing::at_angle(1.001, 1.0)));
  CHECK(turn.unproject({0.6666, 0}));
  CHECK_FALSE(turn.unproject({0.6667, 0}));
  // Without a turn all directions but the one behind are in it.
  const Pinhole<Equidistant<double>> all(1, 1, 0, 0, {0, 0, 0, 0});
  CHECK(all.largest_angle() == std::acos(-1.0));
  CHECK(all.project(testing::at_angle(3.14, 1.0)));
  CHECK_FALSE(all.project({0, 0, -1}));
}

TEST_CASE("equidistant: parameters that are not finite are named") {
  const auto message = testing::message_of([] { return Equidistant<double>(0, 0, 0, NAN); });
  CHECK(message == "Equidistant: coefficients[3] is nan, expected a finite number");
}
