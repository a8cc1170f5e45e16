// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/extended_unified.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::at_angle;
using testing::message_of;

TEMPLATE_TEST_CASE("extended unified: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<ExtendedUnified, TestType>({{250, 250, 319.5, 239.5, 0.51, 0.9},
                                                   {191, 191.2, 254.9, 256.9, 0.63, 1.05},
                                                   {460, 459, 365, 249, 0.35, 1.4},
                                                   {300, 310, 320, 240, 0, 1},
                                                   {300, 310, 320, 240, 1, 1.5},
                                                   {300, 310, 320, 240, 0.5, 0.8}});
}

TEMPLATE_TEST_CASE("extended unified: the image is one-to-one up to the largest angle", "", float, double,
                   long double) {
  using Scalar = TestType;
  for (const Scalar alpha : {Scalar(0), Scalar(0.3), Scalar(0.5), Scalar(0.7), Scalar(1)}) {
    for (const Scalar beta : {Scalar(0.5), Scalar(1), Scalar(2)}) {
      const ExtendedUnified<Scalar> model(300, 310, 320, 240, alpha, beta);
      const Scalar end = model.largest_angle(), step(1e-3F);
      INFO("alpha " << alpha << ", beta " << beta << ", end " << end);
      if (end + step < Scalar(3.14)) CHECK_FALSE(model.project(at_angle<Scalar>(end + step, 1)));
      testing::check_radius_grows(model, end);
      if (alpha > Scalar(0.5)) {
        const Scalar border = 300 / std::sqrt(beta * (2 * alpha - 1));
        CHECK(model.unproject({320 + border * (1 - step), 240}));
        CHECK_FALSE(model.unproject({320 + border * (1 + step), 240}));
      }
    }
  }
}

TEST_CASE("extended unified: with β = 1 it is the double sphere with ξ = 0") {
  const ExtendedUnified<double> model(300, 310, 320, 240, 0.6, 1);
  const DoubleSphere<double> sphere(300, 310, 320, 240, 0, 0.6);
  testing::Uniform uniform(5);
  CHECK(std::abs(model.largest_angle() - sphere.largest_angle()) < 1e-15);
  for (int i = 0; i < 100; ++i) {
    const auto point = testing::random_direction(model, uniform);
    CHECK((model.project(point).value() - sphere.project(point).value()).norm() < 1e-12);
  }
}

TEST_CASE("extended unified: parameters out of range are named") {
  const auto with = [](double fy, double alpha, double beta) {
    return message_of([=] { return ExtendedUnified<double>(300, fy, 320, 240, alpha, beta); });
  };
  CHECK(with(300, 1.5, 1) == "ExtendedUnified: alpha is 1.5, expected a number in [0, 1]");
  CHECK(with(300, 0.5, 0) == "ExtendedUnified: beta is 0, expected a finite number > 0");
  CHECK(with(300, 0.5, -2) == "ExtendedUnified: beta is -2, expected a finite number > 0");
  CHECK(with(300, 0.5, std::nan("")).starts_with("ExtendedUnified: beta is nan"));
  CHECK(with(300, 0.5, 1e200).starts_with("ExtendedUnified: beta is 1e+200"));
  CHECK(with(0, 0.5, 1) == "ExtendedUnified: fy is 0, expected a finite number > 0");
}
