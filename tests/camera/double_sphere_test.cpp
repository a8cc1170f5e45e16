// SPDX-License-Identifier: MIT
#include <splinertia/camera/double_sphere.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::at_angle;
using testing::message_of;

TEMPLATE_TEST_CASE("double sphere: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<DoubleSphere, TestType>({{158, 159, 254, 256, -0.17, 0.59},
                                                {350, 351, 376, 240, 0.12, 0.44},
                                                {300, 310, 320, 240, 0, 0},
                                                {300, 310, 320, 240, 0.25, 0.5},
                                                {300, 310, 320, 240, 1.3, 0.7}});
}

TEMPLATE_TEST_CASE("double sphere: the domain is the image of the inverse", "", float, double, long double) {
  using Scalar = TestType;
  for (const Scalar xi : {Scalar(-0.4), Scalar(-0.2), Scalar(0), Scalar(0.3), Scalar(1), Scalar(1.5)}) {
    for (const Scalar alpha : {Scalar(0), Scalar(0.2), Scalar(0.5), Scalar(0.6), Scalar(1)}) {
      const DoubleSphere<Scalar> model(300, 310, 320, 240, xi, alpha);
      const Scalar end = model.largest_angle();
      INFO("xi " << xi << ", alpha " << alpha << ", end " << end);
      const Scalar step(1e-3F);
      CHECK(model.project(at_angle<Scalar>(end - step, 1)));
      if (end + step < Scalar(3.14)) CHECK_FALSE(model.project(at_angle<Scalar>(end + step, 1)));
      testing::check_radius_grows(model, end);
      if (alpha > Scalar(0.5) && xi <= 0) {
        const Scalar border = 300 / std::sqrt(2 * alpha - 1);
        CHECK(model.unproject({320 + border * (1 - step), 240}));
        CHECK_FALSE(model.unproject({320 + border * (1 + step), 240}));
      }
    }
  }
}

TEST_CASE("double sphere: with ξ = 0, α = 0 it is a pinhole") {
  const auto pixel = DoubleSphere<double>(300, 310, 320, 240, 0, 0).project({1, 2, 4});
  REQUIRE(pixel);
  CHECK(pixel->x() == 395);
  CHECK(pixel->y() == 395);
}

TEST_CASE("double sphere: parameters out of range are named") {
  const auto with = [](double fx, double xi, double alpha) {
    return message_of([=] { return DoubleSphere<double>(fx, 300, 320, 240, xi, alpha); });
  };
  CHECK(with(300, -1, 0.5) == "DoubleSphere: xi is -1, expected a number > -1");
  CHECK(with(300, 0.1, 1.25) == "DoubleSphere: alpha is 1.25, expected a number in [0, 1]");
  CHECK(with(300, 0.1, -0.5) == "DoubleSphere: alpha is -0.5, expected a number in [0, 1]");
  CHECK(with(-300, 0.1, 0.5) == "DoubleSphere: fx is -300, expected a finite number > 0");
  CHECK(with(300, std::nan(""), 0.5).starts_with("DoubleSphere: xi is nan"));
  CHECK(with(300, 0.1, std::nan("")).starts_with("DoubleSphere: alpha is nan"));
}
