// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/camera/equirectangular.hpp>

#include "camera/model_checks.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using testing::message_of;

TEMPLATE_TEST_CASE("equirectangular: projects, inverts, differentiates", "", float, double, long double) {
  testing::check_model<Equirectangular, TestType>({{2048, 1024}, {1000, 400}, {722, 361}});
}

TEST_CASE("equirectangular: forward is the centre, right and down are positive") {
  const Equirectangular<double> model(2048, 1024);
  const auto near = [&](const Eigen::Vector3d& point, double u, double v) {
    return (model.project(point).value() - Eigen::Vector2d(u, v)).norm() < 1e-12;
  };
  CHECK(near({0, 0, 2}, 1024, 512));
  CHECK(near({2, 0, 0}, 1536, 512));
  CHECK(near({-2, 0, 0}, 512, 512));
  CHECK(near({0, 2, 2}, 1024, 768));
  CHECK(near({0, 0, -2}, 2048, 512));
  CHECK(near({-1e-300, 0, -2}, 0, 512));
}

TEST_CASE("equirectangular: the poles are pixels, but no point of the axis has one") {
  const Equirectangular<double> model(2048, 1024);
  CHECK_FALSE(model.project({0, 1, 0}));
  CHECK_FALSE(model.project({0, -1, 0}));
  const auto pole = model.linearize<Wrt::point>({3e-200, 1, 4e-200});
  REQUIRE(pole);
  CHECK(std::abs(pole->pixel.x() - 2048 * (std::atan2(3, 4) / (2 * std::acos(-1.0)) + 0.5)) < 1e-12);
  CHECK(pole->pixel.y() == 1024);
  CHECK(pole->point_jacobian.allFinite());
  REQUIRE(model.unproject({100, 1024}));
  CHECK((*model.unproject({100, 1024}) - Eigen::Vector3d(0, 1, 0)).norm() < 1e-15);
  CHECK((*model.unproject({100, 0}) - Eigen::Vector3d(0, -1, 0)).norm() < 1e-15);
}

TEST_CASE("equirectangular: rays exist in the image only") {
  const Equirectangular<double> model(2048, 1024);
  CHECK(model.unproject({0, 0}));
  CHECK(model.unproject({2048, 1024}));
  CHECK_FALSE(model.unproject({-1e-9, 5}));
  CHECK_FALSE(model.unproject({2048.0001, 5}));
  CHECK_FALSE(model.unproject({5, -1e-9}));
  CHECK_FALSE(model.unproject({5, 1024.0001}));
}

TEST_CASE("equirectangular: parameters out of range are named") {
  const auto with = [](double width, double height) {
    return message_of([=] { return Equirectangular<double>(width, height); });
  };
  CHECK(with(0, 10) == "Equirectangular: width is 0, expected a finite number > 0");
  CHECK(with(10, -4) == "Equirectangular: height is -4, expected a finite number > 0");
  CHECK(with(10, std::nan("")).starts_with("Equirectangular: height is nan"));
}
