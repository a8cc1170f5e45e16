// SPDX-License-Identifier: MIT
#include "../../tools/support/extremes.hpp"

#include <cmath>
#include <splinertia/splinertia.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

const Eigen::Vector3d gravity(0, 0, -9.80665);

/// A circle of 2 m at 1.5 rad/s, 5 s at 100 Hz, as a fit that has found it exactly.
struct Fixture {
  Poses poses{};
  FittedTrajectory fitted{};

  Fixture() {
    const Circle<> circle{.radius = 2, .rate = 1.5, .height = 0};
    fitted.curve = AnyTrajectory(circle, nanoseconds(0), nanoseconds(5'000'000'000));
    fitted.interval = nanoseconds(50'000'000);
    for (int i = 0; i <= 500; ++i) {
      poses.push_back({nanoseconds(10'000'000LL * i), circle.evaluate<0>(0.01 * i).value});
    }
    fitted.smoothed = poses;
    fitted.distances = distances(fitted.smoothed, poses);
  }
};

const double force = std::hypot(2 * 1.5 * 1.5, 9.80665);

}  // namespace

TEST_CASE("a circle has one angular velocity and one specific force, in the curve and in differences") {
  const Fixture f;
  const Extremes found = extremes(f.poses, f.fitted, gravity, 200);
  CHECK(std::abs(found.measured.gyro.value - 1.5) < 1e-12);
  CHECK(std::abs(found.measured.accel.value - force) < 1e-12);
  CHECK(std::abs(found.differences.gyro.value - 1.5) < 1e-9);
  CHECK(std::abs(found.differences.accel.value - force) < 5e-3);  // of h² ω²/12 of the centripetal part
  CHECK_FALSE(found.invented.has_value());
  CHECK(extremes_warnings(found, f.fitted).empty());
}

TEST_CASE("a curve that swings is told from poses that do not, inside a hole and outside") {
  Fixture f;
  f.fitted.curve =
      AnyTrajectory(Circle<>{.radius = 2, .rate = 6, .height = 0}, nanoseconds(0), nanoseconds(5'000'000'000));
  CHECK(extremes_warnings(extremes(f.poses, f.fitted, gravity, 200), f.fitted).size() == 2);
  f.fitted.holes = {{nanoseconds(1'000'000'000), nanoseconds(1'500'000'000)}};
  const Extremes found = extremes(f.poses, f.fitted, gravity, 200);
  REQUIRE(found.invented.has_value());
  CHECK(found.invented->gyro.time > nanoseconds(1'000'000'000));
  CHECK(found.invented->gyro.time < nanoseconds(1'500'000'000));
  CHECK(extremes_text(found, nanoseconds(0)).find("inside holes") != std::string::npos);
}

TEST_CASE("a curve that is too smooth is told") {
  Fixture f;
  f.fitted.curve = AnyTrajectory(at_rest(SO3xR3<double>{}), nanoseconds(0), nanoseconds(5'000'000'000));
  const auto lines = extremes_warnings(extremes(f.poses, f.fitted, gravity, 200), f.fitted);
  REQUIRE(lines.size() == 1);  // 10.8 m/s^2 for 9.8 is not twice as much
  CHECK(lines[0].find("|omega| of 1.5 rad/s, the curve has at most 0 (factor 2 allowed)") != std::string::npos);
}

TEST_CASE("outliers and poses on both sides of a hole make no differences") {
  Fixture f;
  f.poses[200].value = SO3xR3<double>{Sophus::SO3d::rotX(1), Eigen::Vector3d(9, 9, 9)};
  f.fitted.outliers = {200};
  // From here on everything is a metre and a radian elsewhere.
  for (std::size_t i = 300; i < f.poses.size(); ++i) {
    const auto& pose = f.poses[i].value;
    f.poses[i].value = SO3xR3<double>{rotation(pose) * Sophus::SO3d::rotX(1),
                                      Eigen::Vector3d(position(pose) + Eigen::Vector3d(1, 0, 0))};
  }
  f.fitted.holes = {{f.poses[299].time, f.poses[300].time}};
  const Extremes found = extremes(f.poses, f.fitted, gravity, 200);
  CHECK(found.differences.gyro.value < 1.51);
  CHECK(found.differences.accel.value < force + 0.01);
  f.fitted.outliers.clear();
  CHECK(extremes(f.poses, f.fitted, gravity, 200).differences.gyro.value > 50);
}

TEST_CASE("too few poses for differences") {
  Fixture f;
  f.poses.resize(2);
  const Extremes found = extremes(f.poses, f.fitted, gravity, 200);
  CHECK(found.differences.accel.value < 0);
  CHECK(extremes_text(found, nanoseconds(0)).find("         -          -") != std::string::npos);
}
