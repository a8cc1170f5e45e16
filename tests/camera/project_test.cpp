// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/equirectangular.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/project.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;

namespace {

/// Many points, one at a time and all at once: the same are inside, with the same pixels to rounding.
template <typename Model>
void check_many(const Model& model, std::size_t count) {
  using Scalar = typename Model::Scalar;
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> side(-2, 2);
  std::vector<Eigen::Vector3<Scalar>> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(Eigen::Vector3d(side(bits), side(bits), side(bits) + 1).template cast<Scalar>());
  }
  if (count > 2) points[1].x() = std::numeric_limits<Scalar>::quiet_NaN();
  std::vector<Eigen::Vector2<Scalar>> pixels(count, Eigen::Vector2<Scalar>(-1, -1));
  const std::unique_ptr<bool[]> inside(new bool[count]);
  project(model, points, pixels, {inside.get(), count});
  for (std::size_t i = 0; i < count; ++i) {
    const auto alone = model.project(points[i]);
    CHECK(inside[i] == alone.has_value());
    const Eigen::Vector2<Scalar> expected = alone.value_or(Eigen::Vector2<Scalar>::Zero());
    CHECK((pixels[i] - expected).norm() <= 32 * std::numeric_limits<Scalar>::epsilon() * (500 + expected.norm()));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Many points are projected as each alone", "", float, double, long double) {
  using S = TestType;
  for (const std::size_t count : {0, 1, 3, 4, 8, 19, 1000}) {
    check_many(Pinhole<NoDistortion<S>>(460, 460, 320, 240, {}), count);
    check_many(Pinhole<RadialTangential<S>>(458, 457, 367, 248, {S(-0.28), S(0.07), S(2e-4), S(2e-5)}), count);
    check_many(Pinhole<Equidistant<S>>(190, 190, 254, 256, {S(0.0035), S(0.0007), S(-0.002), S(0.0002)}), count);
    check_many(DoubleSphere<S>(313, 313, 638, 514, S(-0.18), S(0.59)), count);
    check_many(Equirectangular<S>(2048, 1024), count);
  }
}

TEST_CASE("Points, pixels and flags are as many of each") {
  const Pinhole<NoDistortion<double>> model(460, 460, 320, 240, {});
  const std::vector<Eigen::Vector3d> points(3, Eigen::Vector3d(0, 0, 1));
  std::vector<Eigen::Vector2d> pixels(2);
  std::array<bool, 3> inside{};
  const auto message = testing::message_of([&] { project(model, points, pixels, inside); });
  CHECK(message == "project: 3 points, 2 pixels, 3 flags, expected as many of each");
}
