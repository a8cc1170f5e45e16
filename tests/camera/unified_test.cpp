// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/unified.hpp>
#include <string_view>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::at_angle;
using testing::message_of;

namespace {

template <typename Scalar>
using Plain = Unified<NoDistortion<Scalar>>;
template <typename Scalar>
using Distorted = Unified<RadialTangential<Scalar>>;

}  // namespace

TEMPLATE_TEST_CASE("unified: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<Plain, TestType>({{0.9, 400, 401.5, 330, 245},
                                         {1, 400, 401.5, 330, 245},
                                         {1.5, 400, 401.5, 330, 245},
                                         {-0.3, 400, 401.5, 330, 245}});
  testing::check_model<Distorted, TestType>({{0.9, 400, 401.5, 330, 245, -0.11, 0.02, 0.0003, -0.0002},
                                             {2.2, 1336, 1335, 717, 705, 0.017, 1.65, 0.0004, 0.0004}});
}

TEMPLATE_TEST_CASE("unified: the image is one-to-one up to the largest angle", "", float, double, long double) {
  using Scalar = TestType;
  const Scalar step(1e-3F);
  const auto check = [&](const auto& model) {
    const Scalar end = model.largest_angle();
    INFO(model.parameters().transpose() << ", end " << end);
    if (end + step < Scalar(3.14)) CHECK_FALSE(model.project(at_angle<Scalar>(end + step, 1)));
    testing::check_radius_grows(model, end);
  };
  for (const Scalar xi : {Scalar(-0.5), Scalar(0), Scalar(0.6), Scalar(1), Scalar(1.6), Scalar(4)}) {
    check(Plain<Scalar>(xi, 300, 310, 320, 240, {}));
    check(Distorted<Scalar>(xi, 300, 310, 320, 240, {Scalar(-0.3), Scalar(0.02), 0, 0}));
  }
}

TEST_CASE("unified: the whole visible part of the sphere, no more") {
  CHECK(std::abs(Plain<double>(0.5, 1, 1, 0, 0, {}).largest_angle() - std::acos(-0.5)) < 1e-15);
  CHECK(std::abs(Plain<double>(2, 1, 1, 0, 0, {}).largest_angle() - std::acos(-0.5)) < 1e-15);
  const Plain<double> outside(2, 1, 1, 0, 0, {});
  const double border = std::sqrt(1 / 3.0);  // tan of the angle at which the sphere is seen: sin = 1/ξ
  CHECK(outside.unproject({border * (1 - 1e-9), 0}));
  CHECK_FALSE(outside.unproject({border * (1 + 1e-9), 0}));
}

TEST_CASE("unified: with ξ = 0 it is the pinhole") {
  const RadialTangential<double> lens(-0.28, 0.07, 0.0002, 0.0001);
  const Unified<RadialTangential<double>> model(0, 460, 461, 320, 240, lens);
  const Pinhole<RadialTangential<double>> pinhole(460, 461, 320, 240, lens);
  testing::Uniform uniform(5);
  for (int i = 0; i < 100; ++i) {
    const auto point = testing::random_direction(pinhole, uniform);
    CHECK(model.project(point).value().isApprox(pinhole.project(point).value(), 1e-12));
  }
}

TEST_CASE("unified: ξ is the first parameter; names") {
  CHECK(Distorted<double>(0.9, 1, 2, 3, 4, {5, 6, 7, 8}).parameters()[0] == 0.9);
  CHECK(Distorted<double>(0.9, 1, 2, 3, 4, {5, 6, 7, 8}).parameters()[5] == 5);
  static_assert(Plain<double>::name == std::string_view("omni-none"));
  static_assert(Distorted<float>::name == std::string_view("omni-radtan"));
  static_assert(Unified<Rational<double>>::name == std::string_view("omni-radtan8"));
}

TEST_CASE("unified: parameters out of range are named") {
  const auto with = [](double xi, double cx) {
    return message_of([=] { return Plain<double>(xi, 300, 300, cx, 240, {}); });
  };
  CHECK(with(-1, 0) == "Unified: xi is -1, expected a number > -1");
  CHECK(with(1e200, 0).starts_with("Unified: xi is 1e+200"));
  CHECK(with(0.5, std::nan("")).starts_with("Unified: cx is nan"));
}
