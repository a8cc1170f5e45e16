// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/camera/line_segment.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using Vector3 = Eigen::Vector3d;

namespace {

constexpr ImageSize size{752, 480};
const Pinhole perspective{458.654, 457.296, 367.215, 248.375, NoDistortion<double>{}};
const Pinhole barrel{458.654, 457.296, 367.215, 248.375, RadialTangential{-0.28340811, 0.07395907, 0.00019, 1.8e-5}};
const Pinhole fisheye{150.0, 150.0, 367.215, 248.375, Equidistant{-0.1, 0.02, -0.01, 0.001}};
const auto still = at_rest(Sophus::SE3d());

struct Stretch {
  double from, to;
};

/// The visible stretches of a segment in the camera frame, from many points at equal angles.
std::vector<Stretch> counted(const auto& camera, const Vector3& a, const Vector3& b) {
  std::vector<Stretch> stretches;
  bool seen = false;
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  for (int i = 0; i <= 20000; ++i) {
    const double x = i / 20000.0, alpha = std::sin((1 - x) * angle) * b.norm(), beta = std::sin(x * angle) * a.norm();
    const double share = beta / (alpha + beta);
    const auto pixel = camera.model().project(a + share * (b - a));
    const bool visible = pixel && camera.sees(*pixel);
    if (visible && !seen) stretches.push_back({share, share});
    if (visible) stretches.back().to = share;
    seen = visible;
  }
  return stretches;
}

void check_segments(const auto& model, double range) {
  const Camera camera{model, size};
  testing::Random random(3);
  const auto vector = [&]() -> Vector3 {
    return Vector3(random.symmetric(), random.symmetric(), random.symmetric()) * range;
  };
  int visible = 0;
  for (int i = 0; i < 150; ++i) {
    const Vector3 a = vector() + Vector3(0, 0, 2), b = vector() + Vector3(0, 0, 2);
    const auto parts = observe_segment(still, camera, a, b, 0.0);
    const auto stretches = counted(camera, a, b);
    INFO("segment " << i);
    REQUIRE(parts.size() == stretches.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      CHECK(std::abs(parts[k].first.share - stretches[k].from) < 1e-2);
      CHECK(std::abs(parts[k].last.share - stretches[k].to) < 1e-2);
      CHECK(parts[k].first.share <= stretches[k].from + 1e-12);
      CHECK(parts[k].last.share >= stretches[k].to - 1e-12);
      for (const auto& end : {parts[k].first, parts[k].last}) {
        CHECK(camera.sees(end.pixel));
        // At the border of the domain the share is rounded.
        const double inwards = end.share == parts[k].first.share ? 1e-12 : -1e-12;
        const auto exact = camera.model().project(a + end.share * (b - a));
        const auto pixel = exact ? exact : camera.model().project(a + (end.share + inwards) * (b - a));
        REQUIRE(pixel);
        CHECK((*pixel - end.pixel).norm() < 1e-8);
        // The part ends at an end of the segment or where the next point is hidden.
        const auto next = camera.model().project(a + (end.share - 1000 * inwards) * (b - a));
        CHECK((end.share == 0 || end.share == 1 || !next || !camera.sees(*next)));
      }
      ++visible;
    }
  }
  CHECK(visible > 20);
}

}  // namespace

TEST_CASE("A segment is clipped to the image and to the model's domain") {
  for (const double range : {1.0, 3.0, 10.0}) {
    check_segments(perspective, range);
    check_segments(barrel, range);
    check_segments(fisheye, range);
  }
}

TEST_CASE("The ends of a visible part") {
  const Pinhole unit{100.0, 100.0, 0.0, 0.0, NoDistortion<double>{}};
  const Camera camera{unit, ImageSize{100, 50}};
  // All of it.
  const auto all = observe_segment(still, camera, Vector3(0.1, 0.1, 1), Vector3(0.5, 0.2, 1), 0.0);
  REQUIRE(all.size() == 1);
  CHECK(all[0].first.share == 0);
  CHECK(all[0].last.share == 1);
  CHECK((all[0].first.pixel - Eigen::Vector2d(10, 10)).norm() < 1e-13);
  CHECK((all[0].last.pixel - Eigen::Vector2d(50, 20)).norm() < 1e-13);
  // From u = −10 to 110 at v = 25, in front of the camera.
  const auto crossing = observe_segment(still, camera, Vector3(-0.1, 0.25, 1), Vector3(1.1, 0.25, 1), 0.0);
  REQUIRE(crossing.size() == 1);
  CHECK(std::abs(crossing[0].first.share - 10 / 120.0) < 1e-14);
  CHECK(std::abs(crossing[0].last.share - 110 / 120.0) < 1e-14);
  // A corner: from (−1, 4) to (4, −1) pixels.
  const auto corner = observe_segment(still, camera, Vector3(-0.01, 0.04, 1), Vector3(0.04, -0.01, 1), 0.0);
  REQUIRE(corner.size() == 1);
  CHECK(std::abs(corner[0].first.share - 0.2) < 1e-14);
  CHECK(std::abs(corner[0].last.share - 0.8) < 1e-14);
  // It begins behind the camera.
  const auto behind = observe_segment(still, camera, Vector3(0.3, 0.2, -3), Vector3(0.3, 0.2, 1), 0.0);
  REQUIRE(behind.size() == 1);
  CHECK(behind[0].last.share == 1);
  CHECK(std::abs(behind[0].first.share - 3.4 / 4) < 1e-3);  // v = 50 at z = 0.4
  CHECK(observe_segment(still, camera, Vector3(-5, 0.1, 1), Vector3(-0.1, 0.1, 1), 0.0).empty());
  CHECK(observe_segment(still, camera, Vector3(0.1, 0.1, -2), Vector3(0.2, 0.1, -1), 0.0).empty());
}

TEST_CASE("A line may leave a distorted image and return") {
  // Bent outwards by the lens, over the upper border.
  const Pinhole lens{400.0, 400.0, 376.0, 240.0, RadialTangential{-0.2, 0.0, 0.0, 0.0}};
  const double y = -240.0 / 400 * 1.06;
  const Camera camera{lens, size};
  int several = 0;
  for (double shift = 0.9; shift < 1.1; shift += 0.001) {
    const Vector3 a(-0.8, y * shift, 1), b(0.8, y * shift, 1);
    const auto parts = observe_segment(still, camera, a, b, 0.0);
    CHECK(parts.size() == counted(camera, a, b).size());
    several += parts.size() == 2;
  }
  CHECK(several > 0);
}

TEST_CASE("Segments that are no image") {
  const Camera camera{perspective, size};
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const Vector3 point(0.1, 0.1, 1);
  CHECK(observe_segment(still, camera, Vector3(nan, 0, 1), point, 0.0).empty());
  CHECK(observe_segment(still, camera, point, Vector3(0, infinity, 1), 0.0).empty());
  CHECK(observe_segment(still, camera, Vector3(0, 0, 0), point, 0.0).empty());
  CHECK(observe_segment(still, camera, -point, point, 0.0).empty());
  // Of length 0, and along a ray: one pixel.
  const auto same = observe_segment(still, camera, point, point, 0.0);
  REQUIRE(same.size() == 1);
  CHECK(same[0].first.pixel == same[0].last.pixel);
  CHECK(observe_segment(still, camera, point, Vector3(3 * point), 0.0).size() == 1);
}

TEMPLATE_TEST_CASE("Segments along a curve, for any scalar", "", float, double, long double) {
  using Scalar = TestType;
  using G = SO3xR3<Scalar>;
  const auto points = testing::Random(5).walk<G>(20, 0.8);
  const Spline<G, 4> curve({.start = 0, .interval = 0.1}, points);
  const Sophus::SE3<Scalar> T_BC(Sophus::SO3<Scalar>(), Eigen::Vector3<Scalar>(1, 2, 3) / Scalar(10));
  const Camera camera{Pinhole{Scalar(400), Scalar(400), Scalar(376), Scalar(240), NoDistortion<Scalar>{}}, size, T_BC};
  const auto pose = curve.template evaluate<0>(1.02).value;
  const Sophus::SE3<Scalar> T_WC = Sophus::SE3<Scalar>(rotation(pose), position(pose)) * T_BC;
  using Point = Eigen::Vector3<Scalar>;
  const auto parts = observe_segment(curve, camera, Point(T_WC * Point(-2, 0, 1)), Point(T_WC * Point(2, 0, 1)), 1.02);
  REQUIRE(parts.size() == 1);
  const Scalar eps = std::numeric_limits<Scalar>::epsilon();
  CHECK(std::abs(parts[0].first.share - (2 - Scalar(376) / 400) / 4) < 32 * eps);
  CHECK(std::abs(parts[0].last.share - (2 + Scalar(376) / 400) / 4) < 32 * eps);
  CHECK_THROWS_AS(observe_segment(curve, camera, Point(0, 0, 1), Point(1, 0, 1), 9.0), std::out_of_range);
}
