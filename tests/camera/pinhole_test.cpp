// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/camera/pinhole.hpp>
#include <string_view>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::message_of;

namespace {

template <typename Scalar>
using Plain = Pinhole<NoDistortion<Scalar>>;

}  // namespace

TEMPLATE_TEST_CASE("pinhole: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<Plain, TestType>({{458.654, 457.296, 367.215, 248.375}, {718.856, 718.856, 607.1928, 185.2157}});
}

TEST_CASE("pinhole: x/z and y/z in pixels, in front of the camera") {
  const Plain<double> model(400, 300, 320, 240, {});
  CHECK(model.project({1, 2, 4}).value() == Eigen::Vector2d(420, 390));
  CHECK_FALSE(model.project({1, 2, -4}));
  CHECK_FALSE(model.project({1, 2, 0}));
  CHECK(std::abs(model.largest_angle() - std::acos(0.0)) < 1e-15);
  CHECK(model.unproject({420, 390}).value().isApprox(Eigen::Vector3d(1, 2, 4).normalized(), 1e-15));
}

TEST_CASE("pinhole: what is not requested does not exist") {
  const Plain<double> model(400, 300, 320, 240, {});

  static_assert(sizeof(*model.linearize<Wrt::nothing>({1, 2, 4})) == sizeof(Eigen::Vector2d));
  static_assert(sizeof(*model.linearize<Wrt::point>({1, 2, 4})) == 8 * sizeof(double));
}

TEST_CASE("pinhole: names") {
  static_assert(Plain<double>::name == std::string_view("pinhole-none"));
  static_assert(Pinhole<RadialTangential<float>>::name == std::string_view("pinhole-radtan"));
  static_assert(Pinhole<Rational<float>>::name == std::string_view("pinhole-radtan8"));
  static_assert(Pinhole<Equidistant<float>>::name == std::string_view("pinhole-equi"));
}

TEST_CASE("pinhole: parameters out of range are named") {
  const auto with = [](double fx, double fy, double cx, double cy) {
    return message_of([=] { return Plain<double>(fx, fy, cx, cy, {}); });
  };
  CHECK(with(0, 300, 320, 240) == "Pinhole: fx is 0, expected a finite number > 0");
  CHECK(with(300, -5, 320, 240) == "Pinhole: fy is -5, expected a finite number > 0");
  CHECK(with(300, 300, INFINITY, 240) == "Pinhole: cx is inf, expected a finite number");
  CHECK(with(300, 300, 320, std::nan("")).starts_with("Pinhole: cy is nan"));
}
