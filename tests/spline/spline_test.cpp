// SPDX-License-Identifier: MIT
#include <chrono>
#include <limits>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

using Curve = Spline<SO3xR3<double>, 4>;
using EpochCurve = Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>>;

TEST_CASE("A spline is a trajectory") {
  STATIC_CHECK(Trajectory<Curve, 2>);
  STATIC_CHECK(Trajectory<EpochCurve, 3>);
}

TEST_CASE("The domain is closed on both sides") {
  testing::Random random(1);
  const Curve curve({.start = 1, .interval = 0.1}, random.walk<SO3xR3<double>>(13));
  CHECK(curve.start() == 1);
  CHECK_THAT(curve.end(), WithinAbs(2, 1e-15));
  CHECK(curve.segments() == 10);
  CHECK_NOTHROW(curve.at<2>(curve.start()));
  CHECK_NOTHROW(curve.at<2>(curve.end()));
  CHECK_THROWS_AS(curve.at<2>(std::nextafter(curve.end(), 3)), std::out_of_range);
  CHECK_THROWS_AS(curve.at<0>(std::nan("")), std::out_of_range);
  CHECK_THROWS_WITH(curve.at<0>(0.5), "Spline: no curve at time 0.5, it is defined from 1 to 2");
}

TEST_CASE("The smallest spline has one segment") {
  testing::Random random(2);
  const Curve curve({.start = 0, .interval = 1}, random.walk<SO3xR3<double>>(4));
  CHECK(curve.segments() == 1);
  CHECK_NOTHROW(curve.at<2>(1));
}

TEST_CASE("The curve and its first two derivatives are continuous across knots") {
  testing::Random random(3);
  const Curve curve({.start = 0, .interval = 0.25}, random.walk<SO3xR3<double>>(9));
  for (const double knot : {0.25, 0.5, 1.0, 1.25}) {
    const auto before = curve.evaluate<2>(std::nextafter(knot, 0.0));
    const auto after = curve.evaluate<2>(knot);
    CHECK(increment(before.value, after.value).norm() < 1e-14);
    CHECK((before.velocity - after.velocity).norm() < 1e-13);
    CHECK((before.acceleration - after.acceleration).norm() < 1e-12);
  }
}

TEST_CASE("Integer time gives the same curve at zero and at an epoch of today") {
  testing::Random random(4);
  const auto points = random.walk<SO3xR3<double>>(9);
  const nanoseconds epoch{1'403'715'524'907'143'168}, interval{100'000'000};
  const EpochCurve zero({nanoseconds{0}, interval}, points), now({epoch, interval}, points);
  for (const int t : {0, 1, 123'456'789, 600'000'000}) {
    const auto a = zero.at<2>(nanoseconds{t});
    const auto b = now.at<2>(epoch + nanoseconds{t});
    CHECK(a.acceleration == b.acceleration);
    CHECK(increment(a.value, b.value).isZero(0));
  }
  // In double seconds an epoch of today resolves 2.4e-7 s: the same curve, as well as time can be told.
  const Curve seconds_curve({.start = 0, .interval = 0.1}, points);
  CHECK((zero.at<2>(nanoseconds{123'456'789}).velocity - seconds_curve.at<2>(0.123456789).velocity).norm() < 1e-13);
}

TEST_CASE("Moving a control point renews what it touches and nothing else") {
  testing::Random random(5);
  auto points = random.walk<SO3xR3<double>>(12);
  Curve curve({.start = 0, .interval = 1}, points);
  const auto far = curve.evaluate<2>(8.5);
  for (const std::size_t i : {0UL, 3UL, 11UL}) {
    points[i] = random.walk<SO3xR3<double>>(1)[0];
    curve.set_control_point(i, points[i]);
    const Curve fresh({.start = 0, .interval = 1}, points);
    CHECK(curve.increments() == fresh.increments());
    if (i == 3) CHECK(curve.evaluate<2>(8.5).acceleration == far.acceleration);
  }
}

TEST_CASE("What cannot be a spline is refused with the reason") {
  testing::Random random(6);
  auto points = random.walk<SO3xR3<double>>(6);
  CHECK_THROWS_WITH((Curve({.start = 0, .interval = 1}, {points[0], points[1], points[2]})),
                    "Spline: 3 control points, expected at least 4, the order of the curve");
  CHECK_THROWS_AS((Curve({.start = 0, .interval = 1}, {})), std::invalid_argument);
  CHECK_THROWS_AS((Curve({.start = 0, .interval = 0}, points)), std::invalid_argument);
  auto broken = points;
  broken[2].get<1>().y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH((Curve({.start = 0, .interval = 1}, broken)),
                    "Spline: control points 1 and 2 are not both finite and of non-zero rotation part");

  Curve curve({.start = 0, .interval = 1}, points);
  CHECK_THROWS_AS(curve.set_control_point(2, broken[2]), std::invalid_argument);
  CHECK(curve.increments() == Curve({.start = 0, .interval = 1}, points).increments());  // as before
}
