// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <splinertia/camera/field_of_view.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::at_angle;
using testing::message_of;

TEMPLATE_TEST_CASE("field of view: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<FieldOfView, TestType>({{258, 258, 320, 240, 0.93},
                                               {200, 201, 255.5, 256.5, 1.3},
                                               {300, 310, 320, 240, 2.5},
                                               {300, 310, 320, 240, 0.01},
                                               {300, 310, 320, 240, 1e-12},
                                               {300, 310, 320, 240, 0}});
}

TEMPLATE_TEST_CASE("field of view: the derivative by w is accurate for every w", "", float, double) {
  using Scalar = TestType;
  const double tolerance = 16 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  for (double w = 1e-3; w < 3.1; w *= 1.3) {
    const FieldOfView<Scalar> model(1, 1, 0, 0, static_cast<Scalar>(w));
    for (double theta = 1e-3; theta < 1.57; theta += 0.03) {
      const auto point = at_angle<Scalar>(static_cast<Scalar>(theta), 0);
      const auto p = model.template linearize<Wrt::parameters>(point);
      REQUIRE(p);
      // d/dw of atan(q)/w, q = 2 tan(w/2) tan(θ): two terms, of which the difference is small when both angles are.
      const long double l = static_cast<long double>(static_cast<Scalar>(w));
      const long double q =
          2 * std::tan(l / 2) * (static_cast<long double>(point.x()) / static_cast<long double>(point.z()));
      const long double first = q / (1 + q * q) / std::sin(l) / l, second = std::atan(q) / l / l;
      const auto got = static_cast<long double>(p->parameter_jacobian(0, 4));
      const long double rho = q / l, size = (std::min)(first + second, rho * l * (1 + rho * rho));  // of the terms
      INFO("w " << w << ", theta " << theta);
      CHECK(std::abs(static_cast<double>((got - (first - second)) / size)) < tolerance + 1e-19 / (w * w * w));
    }
  }
}

TEST_CASE("field of view: w = 0 is the pinhole, small w close to it") {
  const Eigen::Vector3d point(1, -2, 4);
  const auto none = FieldOfView<double>(300, 310, 320, 240, 0).linearize<Wrt::parameters>(point);
  REQUIRE(none);
  CHECK(none->pixel == Eigen::Vector2d(395, 85));
  CHECK(none->parameter_jacobian.col(4).isZero(0));
  const auto some = FieldOfView<double>(300, 310, 320, 240, 1e-5).project(point);
  CHECK((some.value() - none->pixel).norm() < 1e-7);
  CHECK((some.value() - none->pixel).norm() > 0);
  CHECK(FieldOfView<double>(300, 310, 320, 240, std::numeric_limits<double>::denorm_min()).project(point) ==
        none->pixel);
}

TEST_CASE("field of view: domain and image end at right angles to the axis") {
  const FieldOfView<double> model(300, 310, 320, 240, 0.9);
  CHECK(std::abs(model.largest_angle() - std::acos(0.0)) < 1e-15);
  CHECK(model.project(at_angle<double>(1.57, 1)));
  CHECK_FALSE(model.project(at_angle<double>(1.571, 1)));
  const double border = 300 * std::acos(0.0) / 0.9;
  CHECK(model.unproject({320 + border * (1 - 1e-9), 240}));
  CHECK_FALSE(model.unproject({320 + border * (1 + 1e-9), 240}));
}

TEST_CASE("field of view: parameters out of range are named") {
  const auto with = [](double w) { return message_of([=] { return FieldOfView<double>(300, 300, 320, 240, w); }); };
  CHECK(with(-0.5) == "FieldOfView: w is -0.5, expected a number in [0, pi)");
  CHECK(with(3.25) == "FieldOfView: w is 3.25, expected a number in [0, pi)");
  CHECK(with(std::nan("")).starts_with("FieldOfView: w is nan"));
}
