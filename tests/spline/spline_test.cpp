// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/trajectory.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

using Curve = Spline<SO3xR3<double>, 4>;
using EpochCurve = Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>>;
template <int Order, typename Time = double>
using FreeCurve = Spline<SO3xR3<double>, Order, NonUniformKnots<Time>>;

TEST_CASE("A spline is a trajectory") {
  STATIC_CHECK(Trajectory<Curve, 2>);
  STATIC_CHECK(Trajectory<EpochCurve, 3>);
  STATIC_CHECK(Trajectory<FreeCurve<4>, 3>);
  STATIC_CHECK(Trajectory<FreeCurve<5, nanoseconds>, 2>);
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
  CHECK_THROWS_WITH(
      (Curve({.start = 0, .interval = 1}, broken)),
      "Spline: control points 1 and 2 have no finite increment, expected finite values and a non-zero rotation part");

  Curve curve({.start = 0, .interval = 1}, points);
  CHECK_THROWS_AS(curve.set_control_point(2, broken[2]), std::invalid_argument);
  CHECK(curve.increments() == Curve({.start = 0, .interval = 1}, points).increments());  // as before
}

namespace {

/// The same knots, written down one by one.
template <typename Time>
NonUniformKnots<Time> spelled_out(const UniformKnots<Time>& knots, std::size_t control_points, int order) {
  NonUniformKnots<Time> all;
  for (int i = 1 - order; i <= static_cast<int>(control_points); ++i) {
    all.knots.push_back(knots.start + i * knots.interval);
  }
  return all;
}

template <typename G, int Order, typename Time>
void check_uniform_data(const UniformKnots<Time>& knots, double tolerance) {
  INFO("order " << Order);
  testing::Random random(Order);
  const auto points = random.walk<G>(Order + 6);
  const Spline<G, Order, UniformKnots<Time>> uniform(knots, points);
  const Spline<G, Order, NonUniformKnots<Time>> free(spelled_out(knots, points.size(), Order), points);
  CHECK(free.start() == uniform.start());
  CHECK(free.end() == uniform.end());
  CHECK(free.segments() == uniform.segments());
  for (int i = 0; i <= 70; ++i) {
    const Time t = i == 70 ? uniform.end() : knots.start + i * knots.interval / 10;
    const auto a = uniform.template at<3>(t);
    const auto b = free.template at<3>(t);
    const double rate = 1 / to_seconds<double>(knots.interval);
    CHECK(increment<G>(a.value, b.value).norm() < tolerance);
    // Derivative k − 1 jumps at knots, and rounding decides which side it is.
    const int smooth = i % 10 == 0 ? Order - 2 : 3;
    if (smooth >= 1) CHECK((a.velocity - b.velocity).norm() < tolerance * rate);
    if (smooth >= 2) CHECK((a.acceleration - b.acceleration).norm() < 4 * tolerance * rate * rate);
    if (smooth >= 3) CHECK((a.jerk - b.jerk).norm() < 16 * tolerance * rate * rate * rate);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Uniform data in a non-uniform spline gives the uniform spline", "", SO3xR3<double>,
                   Eigen::Vector3d) {
  const auto check = []<int Order>() {
    // A quarter of a second and nanoseconds are exact: only the formulas round. Knots at multiples of 0.1 are rounded.
    check_uniform_data<TestType, Order>(UniformKnots{-1.0, 0.25}, 1e-14);
    check_uniform_data<TestType, Order>(UniformKnots{0.3, 0.1}, 3e-14);
    check_uniform_data<TestType, Order>(UniformKnots{nanoseconds{1'403'715'524'907'143'168}, nanoseconds{50'000'000}},
                                        1e-14);
  };
  check.template operator()<2>();
  check.template operator()<3>();
  check.template operator()<4>();
  check.template operator()<5>();
  check.template operator()<6>();
}

TEST_CASE("Clustered knots and ratios of a million keep the derivatives right and the curve smooth") {
  testing::Random random(8);
  const auto points = random.walk<SO3xR3<double>>(9);
  const auto check = [&](const FreeCurve<5>& curve) {
    const auto& knots = curve.knots().knots;
    for (std::size_t i = 4; i < points.size(); ++i) {
      const double a = knots[i], b = knots[i + 1];
      INFO("span from " << a << " to " << b);
      // Differences at a distance that is right for the span; a time is rounded by more or less of it.
      const double length = b - a, middle = a + length / 2, eps = std::numeric_limits<double>::epsilon();
      const auto m = curve.evaluate<3>(middle);
      const auto errors = testing::derivative_errors<3>(curve, middle, length / 256);
      const double bound = 1e-9 + 1024 * eps * std::abs(b) / length;
      const double v = m.velocity.norm() + 1e-4 / length, acceleration = m.acceleration.norm() + v / length;
      CHECK(errors[0] < bound * v);
      CHECK(errors[1] < bound * acceleration);
      CHECK(errors[2] < bound * (m.jerk.norm() + acceleration / length));
      // Both sides of the knot, as far from it as the next double.
      const auto before = curve.evaluate<2>(std::nextafter(b, a));
      const auto after = curve.evaluate<2>(b);
      const double step = b - std::nextafter(b, a);
      CHECK(increment(before.value, after.value).norm() < 1e-14 + 2 * after.velocity.norm() * step);
      CHECK((before.velocity - after.velocity).norm() <
            1e-13 * (1 + after.velocity.norm()) + 2 * after.acceleration.norm() * step);
    }
  };
  check({{.knots = {0, 1, 2, 3, 4, 4 + 1e-6, 4 + 2e-6, 5, 6, 6 + 1e-6, 7, 8, 9, 10}}, points});
  check({{.knots = {0, 1e-3, 1, 2, 3, 3.001, 1003.001, 1003.002, 1004, 1004.001, 2004, 2005, 2006, 2007}}, points});
}

TEST_CASE("A knot that is there m times leaves k - 1 - m derivatives") {
  testing::Random random(9);
  const auto points = random.walk<SO3xR3<double>>(9);
  const double knot = 5;
  const auto jumps = [&](std::vector<double> knots) {
    const FreeCurve<4> curve({std::move(knots)}, points);
    const auto before = curve.at<2>(std::nextafter(knot, 0));
    const auto after = curve.at<2>(knot);
    return std::array<double, 3>{increment(before.value, after.value).norm(), (before.velocity - after.velocity).norm(),
                                 (before.acceleration - after.acceleration).norm()};
  };
  const auto simple = jumps({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  CHECK(simple[0] < 1e-14);
  CHECK(simple[1] < 1e-14);
  CHECK(simple[2] < 1e-13);
  const auto twice = jumps({0, 1, 2, 3, 4, 5, 5, 6, 7, 8, 9, 10, 11});
  CHECK(twice[0] < 1e-14);
  CHECK(twice[1] < 1e-14);
  CHECK(twice[2] > 0.01);
  const auto thrice = jumps({0, 1, 2, 3, 4, 5, 5, 5, 6, 7, 8, 9, 10});
  CHECK(thrice[0] < 1e-14);
  CHECK(thrice[1] > 0.01);
  // There the curve goes through a control point: span [5, 6] is that of X_4 … X_7.
  const FreeCurve<4> curve({.knots = {0, 1, 2, 3, 4, 5, 5, 5, 6, 7, 8, 9, 10}}, points);
  CHECK(increment(points[4], curve.at<0>(5).value).norm() < 1e-14);
}

TEST_CASE("Order coinciding knots at the ends clamp the curve to its first and last control points") {
  testing::Random random(10);
  const auto points = random.walk<SO3xR3<double>>(6);
  const FreeCurve<4> curve({.knots = {1, 1, 1, 1, 1.5, 4, 5, 5, 5, 5}}, points);
  CHECK(curve.start() == 1);
  CHECK(curve.end() == 5);
  CHECK(increment(points.front(), curve.at<0>(1).value).isZero(0));
  CHECK(increment(points.back(), curve.at<0>(5).value).norm() < 1e-14);
  CHECK_THROWS_WITH(curve.at<0>(5.5), "Spline: no curve at time 5.5, it is defined from 1 to 5");
  CHECK_THROWS_AS(curve.at<0>(std::nextafter(1, 0)), std::out_of_range);
  CHECK_THROWS_AS(curve.at<0>(std::nan("")), std::out_of_range);
}

TEST_CASE("Non-uniform knots in nanoseconds: the same curve at zero, at an epoch of today and in seconds") {
  testing::Random random(11);
  const auto points = random.walk<SO3xR3<double>>(7);
  const nanoseconds epoch{1'403'715'524'907'143'168};
  NonUniformKnots<nanoseconds> zero, now;
  NonUniformKnots<double> in_seconds;
  for (const int ms : {-250, -125, 0, 125, 500, 625, 640, 1000, 1500, 1625, 1750}) {
    zero.knots.emplace_back(ms * 1'000'000LL);
    now.knots.push_back(epoch + zero.knots.back());
    in_seconds.knots.push_back(ms * 1e-3);
  }
  const FreeCurve<4, nanoseconds> a(zero, points), b(now, points);
  const FreeCurve<4> c(in_seconds, points);
  for (const std::int64_t t : {125'000'000, 125'000'001, 333'333'333, 630'000'000, 999'999'999, 1'000'000'000}) {
    const auto at_zero = a.at<2>(nanoseconds{t}), at_epoch = b.at<2>(epoch + nanoseconds{t});
    CHECK(at_zero.acceleration == at_epoch.acceleration);
    CHECK(increment(at_zero.value, at_epoch.value).isZero(0));
    const auto at_seconds = c.at<2>(static_cast<double>(t) * 1e-9);
    CHECK(increment(at_zero.value, at_seconds.value).norm() < 1e-14);
    CHECK((at_zero.velocity - at_seconds.velocity).norm() < 1e-12);
    CHECK((at_zero.acceleration - at_seconds.acceleration).norm() < 1e-10);
  }
}

TEST_CASE("A spline refuses knots that do not fit, and control points move on any knots") {
  testing::Random random(12);
  auto points = random.walk<SO3xR3<double>>(6);
  CHECK_THROWS_WITH((FreeCurve<4>({.knots = {0, 1, 2, 3, 4, 5, 6, 7}}, points)),
                    "NonUniformKnots: 8 knots, expected 10: 6 control points plus the order, 4");
  CHECK_THROWS_WITH((FreeCurve<4>({.knots = {0, 1, 2, 3, 4, 5}}, {points[0], points[1]})),
                    "Spline: 2 control points, expected at least 4, the order of the curve");
  const std::vector<double> knots{0, 1, 2, 3, 3.5, 4, 6, 7, 8, 9};
  FreeCurve<4> curve({knots}, points);
  points[2] = random.walk<SO3xR3<double>>(1)[0];
  curve.set_control_point(2, points[2]);
  CHECK(curve.increments() == FreeCurve<4>({knots}, points).increments());
  CHECK(curve.knots().knots == knots);
}

TEST_CASE("A spline linearizes with respect to the control points that shape it") {
  testing::Random random(8);
  const auto points = random.walk<SO3xR3<double>>(9);
  const Curve curve({.start = 0, .interval = 0.5}, points);
  const auto at = curve.linearize<2>(1.7);
  CHECK(at.first == 3);
  CHECK(at.velocity == curve.evaluate<2>(1.7).velocity);
  const double h = 1e-6;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Curve moved = curve;
    const Tangent<SO3xR3<double>> delta = random.tangent<SO3xR3<double>>(h);
    moved.set_control_point(i,
                            GroupTraits<SO3xR3<double>>::compose(points[i], GroupTraits<SO3xR3<double>>::exp(delta)));
    const Tangent<SO3xR3<double>> change = moved.evaluate<1>(1.7).velocity - at.velocity;
    if (i < at.first || i >= at.first + 4) {
      CHECK(change.isZero(0));
    } else {
      CHECK((change - at.velocity_jacobian[i - at.first] * delta).norm() < 1e-10);  // h² times the second derivative
    }
  }
}

TEST_CASE("A control point that has drifted is brought back, one that is none is refused") {
  testing::Random random(9);
  const auto exact = random.walk<Sophus::SE3d>(6);
  const auto stretched = [](Sophus::SE3d x, double factor) {
    for (int i = 0; i < 4; ++i) x.data()[i] *= factor;
    return x;
  };
  using RigidCurve = Spline<Sophus::SE3d, 4>;
  const RigidCurve reference({.start = 0, .interval = 1}, exact);
  auto drifted = exact;
  drifted[2] = stretched(exact[2], 1 + 1e-6);
  RigidCurve curve({.start = 0, .interval = 1}, drifted);
  const auto got = curve.evaluate<2>(1.5), expected = reference.evaluate<2>(1.5);
  CHECK(std::abs(got.value.unit_quaternion().norm() - 1) < 1e-15);
  CHECK((got.value.translation() - expected.value.translation()).norm() < 1e-14);
  CHECK((got.acceleration - expected.acceleration).norm() < 1e-13);

  curve.set_control_point(3, stretched(exact[3], 1 - 1e-4));
  CHECK(std::abs(curve.control_points()[3].unit_quaternion().norm() - 1) < 1e-15);
  CHECK(curve.control_points()[1].unit_quaternion().coeffs() ==
        exact[1].unit_quaternion().coeffs());  // taken as it was

  CHECK_THROWS_WITH(
      curve.set_control_point(3, stretched(exact[3], 2)),
      "Spline: control point 3 is off its group by 1, expected at most 0.001 (the norm of a rotation is 1)");
  drifted[4] = stretched(exact[4], 0);
  CHECK_THROWS_AS(RigidCurve({.start = 0, .interval = 1}, drifted), std::invalid_argument);
}
