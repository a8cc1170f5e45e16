// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/fit/detail/knots_over.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;
using testing::message_of;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;
using Even = Spline<Number, 4>;
using Free = Spline<Number, 4, NonUniformKnots<double>>;
using Epoch = Spline<Number, 4, UniformKnots<nanoseconds>>;

template <typename Curve>
PosesOf<Curve> ramp(typename Curve::Time from, typename Curve::Time step, int count) {
  PosesOf<Curve> poses;
  for (int i = 0; i < count; ++i) poses.push_back({from + i * step, Number(3 + 0.5 * i)});
  return poses;
}

}  // namespace

TEST_CASE("Knots are spread evenly from the first to the last pose") {
  auto poses = ramp<Even>(2, 0.1, 101);
  SECTION("no further apart than asked for") {
    const auto [knots, control_points] = knots_over<Even>(poses, {.knot_interval = 0.3});
    CHECK(control_points == 34 + 3);
    CHECK(knots.start == 2);
    CHECK_THAT(knots.interval, WithinRel(10. / 34, 1e-14));
    CHECK(knots.domain(control_points, 4).end >= poses.back().time);
  }
  SECTION("not one too many because of rounding") {
    CHECK(knots_over<Even>(poses, {.knot_interval = 0.1}).second == 100 + 3);
    CHECK(knots_over<Even>(poses, {.knot_interval = 0.2}).second == 50 + 3);
  }
  SECTION("at least one segment") {
    const auto [knots, control_points] = knots_over<Even>(poses, {.knot_interval = 1e9});
    CHECK(control_points == 4);
    CHECK_THAT(knots.interval, WithinRel(10.0, 1e-14));
  }
}

TEST_CASE("Even knots reach to the last pose, whatever rounding says") {
  testing::Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double first = 1e3 * random.symmetric(), last = first + 50 + 49 * random.symmetric();
    const std::size_t segments = 1 + static_cast<std::size_t>(trial);
    const auto knots = even_knots<UniformKnots<double>>(first, last, segments, 4);
    CHECK(knots.knot(segments, 4) >= last);
    CHECK(knots.knot(segments, 4) <= last + 1e-12 * std::abs(last) + 1e-12);
  }
  const nanoseconds epoch{1'403'715'524'907'143'168};
  const auto knots = even_knots<UniformKnots<nanoseconds>>(epoch, epoch + nanoseconds{1'000'000'000}, 7, 4);
  CHECK(knots.interval == nanoseconds{142'857'143});
  CHECK(knots.start == epoch);
}

TEST_CASE("Even non-uniform knots coincide at the ends") {
  const auto knots = even_knots<NonUniformKnots<double>>(1.0, 2.0, 4, 3);
  CHECK(knots.knots == std::vector<double>{1, 1, 1, 1.25, 1.5, 1.75, 2, 2, 2});
  auto poses = ramp<Free>(0, 1, 9);
  const auto [over, control_points] = knots_over<Free>(poses, {.knot_interval = 2});
  CHECK(control_points == 7);
  CHECK(over.knots == std::vector<double>{0, 0, 0, 0, 2, 4, 6, 8, 8, 8, 8});
}

TEST_CASE("Knots of one's own") {
  SECTION("uniform ones go on to the last pose") {
    auto poses = ramp<Even>(1, 0.5, 20);  // to 10.5
    const auto [knots, control_points] = knots_over<Even>(poses, {.knots = UniformKnots<double>{0.5, 0.75}});
    CHECK(knots.start == 0.5);
    CHECK(knots.interval == 0.75);
    CHECK(control_points == 14 + 3);
  }
  SECTION("a last pose that is behind the last knot by rounding is moved onto it") {
    auto poses = ramp<Even>(0, 0.1, 31);  // 30·0.1 > 3
    poses.back().time = 3.0000000000000004;
    const auto [knots, control_points] = knots_over<Even>(poses, {.knots = UniformKnots<double>{0, 0.5}});
    CHECK(control_points == 6 + 3);
    CHECK(poses.back().time == 3);
  }
  SECTION("non-uniform ones stay as they are") {
    auto poses = ramp<Free>(0, 0.1, 31);
    const std::vector<double> own{-3, -2, -1, 0, 0.5, 2, 3.5, 4, 5, 6};
    const auto [knots, control_points] = knots_over<Free>(poses, {.knots = NonUniformKnots<double>{own}});
    CHECK(knots.knots == own);
    CHECK(control_points == 6);
  }
}

TEST_CASE("Knots that do not reach over the poses are refused") {
  auto poses = ramp<Even>(1, 0.5, 20);
  CHECK(message_of([&] { return knots_over<Even>(poses, {.knots = UniformKnots<double>{1.25, 0.5}}); }) ==
        "fit: poses from 1 to 10.5, but the knots reach from 1.25 to 10.75; expected knots that cover all poses");
  CHECK(message_of([&] { return knots_over<Even>(poses, {.knots = UniformKnots<double>{20, 0.5}}); }) ==
        "fit: poses from 1 to 10.5, but the knots reach from 20 to 20.5; expected knots that cover all poses");
  CHECK(message_of([&] { return knots_over<Even>(poses, {.knots = UniformKnots<double>{1, -1}}); }) ==
        "UniformKnots: interval is -1, expected a positive finite number");
  auto free = ramp<Free>(1, 0.5, 20);
  CHECK(message_of([&] {
          return knots_over<Free>(free, {.knots = NonUniformKnots<double>{{0, 0, 0, 0, 5, 10, 10, 10, 10}}});
        }) == "fit: poses from 1 to 10.5, but the knots reach from 0 to 10; expected knots that cover all poses");
  CHECK(message_of([&] { return knots_over<Free>(free, {.knots = NonUniformKnots<double>{{0, 1, 2}}}); }) ==
        "fit: 3 knots, expected at least 8, twice the order of the curve");
  CHECK(message_of([&] {
          return knots_over<Free>(free, {.knots = NonUniformKnots<double>{{0, 0, 0, 0, 5, 4, 11, 11, 11, 11}}});
        }) == "NonUniformKnots: knot 5 is 4, expected at least 5, the knot before it");
}

TEST_CASE("Knots a hundred times as many as poses are refused before they take memory") {
  auto poses = ramp<Even>(0, 1, 11);
  CHECK(message_of([&] { return knots_over<Even>(poses, {.knot_interval = 1e-9}); }) ==
        "fit: knots 1e-09 s apart over 10 s give more than 1100 segments, a hundred per pose; expected a longer "
        "interval");
  CHECK(message_of([&] { return knots_over<Even>(poses, {.knot_interval = 1e-320}); }).find("a hundred per pose") !=
        std::string::npos);
  CHECK(message_of([&] { return knots_over<Even>(poses, {.knots = UniformKnots<double>{-1e12, 1}}); }) ==
        "fit: knots 1 s apart over 1.00000000001e+12 s give more than 1100 segments, a hundred per pose; expected "
        "a longer interval");
}

TEST_CASE("Where a fit starts: a straight line is met at once, on any knots") {
  // Σ w_i(t) ξ_i = t for the times ξ of the control points (Marsden).
  auto poses = ramp<Free>(0, 0.5, 21);
  const NonUniformKnots<double> own{{0, 0, 0, 0, 1, 1.25, 4, 9, 10, 10, 10, 10}};
  const Free curve = poses_at_control_points<Free>(poses, own, 8);
  for (const double t : {0.0, 0.3, 1.1, 3.0, 7.7, 10.0}) {
    CHECK_THAT(curve.evaluate<0>(t).value[0], WithinAbs(3 + t, 1e-14));
  }
  // Uniform knots have control points outside the domain, where the nearest pose stands in.
  auto even = ramp<Even>(0, 0.5, 21);
  const Even smooth = poses_at_control_points<Even>(even, {0, 1}, 13);
  CHECK(smooth.control_points()[0] == Number(3));
  CHECK(smooth.control_points()[12] == Number(13));
  CHECK_THAT(smooth.evaluate<0>(5.25).value[0], WithinAbs(8.25, 1e-14));
}

TEST_CASE("Options that make no sense are refused") {
  using Options = FitOptions<Even>;
  const auto why = [](const Options& options, std::size_t poses = 10) {
    return message_of([&] { return check(options, poses), 0; });
  };
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const UniformKnots<double> knots{0, 1};
  CHECK(why({.knot_interval = 1}) == "nothing thrown");
  CHECK(why({.knots = knots}) == "nothing thrown");
  CHECK(why({.knot_interval = 1}, 1) == "fit: 1 poses, expected at least 2");
  CHECK(why({.knot_interval = 1}, 0) == "fit: 0 poses, expected at least 2");
  CHECK(why({.knot_interval = 1, .knots = knots}) == "fit: expected knot_interval or knots, and not both");
  CHECK(why({.knot_interval = 0}) == "fit: knot_interval is 0, expected a finite number > 0");
  CHECK(why({.knot_interval = -0.1}) == "fit: knot_interval is -0.1, expected a finite number > 0");
  CHECK(why({.knot_interval = nan}) == "fit: knot_interval is nan, expected a finite number > 0");
  CHECK(why({.knot_interval = infinity}) == "fit: knot_interval is inf, expected a finite number > 0");
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    CHECK(why({.knot_interval = 1, .standard_deviation = Number(bad)}) ==
          "fit: expected every component of standard_deviation to be a finite number > 0");
    CHECK(why({.knot_interval = 1, .smoothness = Smoothness<Number>{.density = Number(bad)}}) ==
          "fit: expected every component of smoothness.density to be a finite number > 0");
  }
  CHECK(why({.knot_interval = 1, .weights = {1, 1, 1}}) == "fit: 3 weights for 10 poses, expected one each, or none");
  CHECK(why({.knot_interval = 1, .weights = {1, -2}}, 2) == "fit: weight 1 is -2, expected a finite number >= 0");
  CHECK(why({.knot_interval = 1, .weights = {nan, 1}}, 2) == "fit: weight 0 is nan, expected a finite number >= 0");
  CHECK(why({.knot_interval = 1, .weights = {1, infinity}}, 2) ==
        "fit: weight 1 is inf, expected a finite number >= 0");
  for (const int derivative : {-1, 1, 4}) {
    CHECK(why({.knot_interval = 1, .smoothness = Smoothness<Number>{derivative, Number(1)}}) ==
          message("fit: smoothness of derivative ", derivative, ", expected 2 or 3, and less than the order, 4"));
  }
  CHECK(message_of([] {
          return check(
                     FitOptions<Spline<Number, 3>>{.knot_interval = 1, .smoothness = Smoothness<Number>{3, Number(1)}},
                     10),
                 0;
        }) == "fit: smoothness of derivative 3, expected 2 or 3, and less than the order, 3");
  CHECK(why({.knot_interval = 1, .outlier_limit = 0}) == "fit: outlier_limit is 0, expected a finite number > 0");
  CHECK(why({.knot_interval = 1, .most_iterations = 0}) == "fit: most_iterations is 0, expected at least 1");
}

TEST_CASE("Knots in nanoseconds over poses at an epoch of today") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  auto poses = ramp<Epoch>(epoch, nanoseconds{5'000'000}, 2001);  // 10 s
  const auto [knots, control_points] = knots_over<Epoch>(poses, {.knot_interval = 0.05});
  CHECK(knots.start == epoch);
  CHECK(knots.interval == nanoseconds{50'000'000});
  CHECK(control_points == 203);
}
