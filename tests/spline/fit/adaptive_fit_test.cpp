// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/adaptive_fit.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using G = SO3xR3<double>;
using Curve = Spline<G, 4, NonUniformKnots<double>>;
using Poses = std::vector<Stamped<G, double>>;

/// 10 s at 100 Hz: slow, but for half a second around t = 5 s, where it shakes; with white noise.
Poses shaken(double noise) {
  NormalStream normal{StreamKey(1)};
  Poses poses;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i;
    const double shake = 0.2 * std::exp(-std::pow((t - 5) / 0.25, 2)) * std::sin(40 * t);
    Tangent<G> error;
    for (double& x : error) x = noise * normal();
    const G value{Sophus::SO3d::exp(Eigen::Vector3d(std::sin(0.5 * t), 0.3 * std::cos(0.7 * t) + shake, 0.2 * t)),
                  Eigen::Vector3d(std::cos(0.6 * t), shake, std::sin(0.4 * t))};
    poses.push_back({t, GroupTraits<G>::compose(value, GroupTraits<G>::exp(error))});
  }
  return poses;
}

Tangent<G> all(double x) { return Tangent<G>::Constant(x); }

std::size_t knots_between(const Curve& curve, double from, double to) {
  const auto& knots = curve.knots().knots;
  return static_cast<std::size_t>(
      std::count_if(knots.begin(), knots.end(), [&](double knot) { return knot > from && knot < to; }));
}

}  // namespace

TEST_CASE("Knots are dense where the motion is fast, and few elsewhere") {
  const auto poses = shaken(0);
  const auto goal = all(1e-3);
  const auto adaptive = adaptive_fit<Curve>(poses, goal);
  CHECK((adaptive.residuals.component_rms.array() <= goal.array()).all());
  const auto uniform = fit<Curve>(poses, {.knot_interval = coarsest_knot_interval<Curve>(poses, goal)});
  const std::size_t fine = adaptive.spline.control_points().size(), even = uniform.spline.control_points().size();
  INFO(fine << " control points, evenly spread " << even);
  CHECK(fine < even / 2);
  const std::size_t fast = knots_between(adaptive.spline, 4.5, 5.5), slow = knots_between(adaptive.spline, 0, 4);
  INFO(fast << " knots within the fast second, " << slow << " in four slow ones");
  CHECK(fast > 4 * slow);
}

TEST_CASE("Noise alone takes no knots") {
  const auto noise = 0.01;
  auto poses = shaken(noise);
  const auto shaking = adaptive_fit<Curve>(poses, all(noise));
  CHECK(shaking.spline.control_points().size() < 60);
  CHECK((shaking.residuals.component_rms.array() < 1.1 * noise).all());

  NormalStream normal{StreamKey(2)};
  for (auto& pose : poses) {
    Tangent<G> error;
    for (double& x : error) x = noise * normal();
    pose.value = GroupTraits<G>::exp(error);
  }
  // Four spans to begin with; that one of 24 components exceeds three standard deviations has a chance of 3 %.
  CHECK(adaptive_fit<Curve>(poses, all(noise)).spline.control_points().size() == 7);
}

TEST_CASE("Knots do not pile up at jumps where the loss is robust") {
  const double noise = 0.002;
  auto poses = shaken(noise);
  const auto without = adaptive_fit<Curve>(poses, all(noise)).spline.control_points().size();
  for (const std::size_t i : {100UL, 101UL, 250UL, 251UL, 333UL, 700UL, 701UL, 900UL}) {
    poses[i].value = GroupTraits<G>::compose(poses[i].value, GroupTraits<G>::exp(all(0.3)));
  }
  const auto robust = adaptive_fit<Curve>(poses, all(noise), {.loss = RobustLoss::cauchy()});
  CHECK(robust.spline.control_points().size() <= without + without / 5);
  for (const double t : {1.0, 2.5, 3.33, 7.0, 9.0}) CHECK(knots_between(robust.spline, t - 0.1, t + 0.1) <= 1);
  // With squares they do.
  const auto squares = adaptive_fit<Curve>(poses, all(noise));
  CHECK(squares.spline.control_points().size() > without + 20);
}

TEST_CASE("A goal that cannot be reached ends with a few poses in each span") {
  testing::Random random(3);
  const auto check = [&]<typename C>(std::size_t count, C*) {
    Poses poses;
    for (std::size_t i = 0; i < count; ++i) {
      poses.push_back({static_cast<double>(i), GroupTraits<G>::exp(random.tangent<G>(0.1))});
    }
    const auto result = adaptive_fit<C>(poses, all(1e-9));
    INFO(count << " poses, order " << C::order);
    CHECK(result.spline.control_points().size() <= count);
    CHECK(result.spline.control_points().size() >= count / 3);
  };
  for (const std::size_t count : {6UL, 7UL, 8UL, 9UL, 12UL, 50UL, 301UL}) {
    check(count, static_cast<Curve*>(nullptr));
    check(count, static_cast<Spline<G, 6, NonUniformKnots<double>>*>(nullptr));
  }
}

TEST_CASE("Knots of one's own are where it starts") {
  const auto poses = shaken(0);
  const NonUniformKnots<double> knots{{-1, 0, 0, 0, 3, 3.1, 3.1, 7, 10, 10, 10, 12}};
  const auto result = adaptive_fit<Curve>(poses, all(1e-3), {.knots = knots});
  CHECK((result.residuals.component_rms.array() <= 1e-3).all());
  const auto& found = result.spline.knots().knots;
  CHECK(std::includes(found.begin(), found.end(), knots.knots.begin(), knots.knots.end()));
  CHECK(found.front() == -1);
  CHECK(found.back() == 12);
}

TEST_CASE("A goal that is none is refused") {
  const auto poses = shaken(0);
  const auto refusal = [&](double component) {
    auto goal = all(0.1);
    goal[2] = component;
    return testing::message_of([&] { return adaptive_fit<Curve>(poses, goal).converged; });
  };
  const std::string expected = "adaptive_fit: component 2 of the goal is ";
  CHECK(refusal(0) == expected + "0, expected a finite number > 0");
  CHECK(refusal(-0.1) == expected + "-0.1, expected a finite number > 0");
  CHECK(refusal(std::numeric_limits<double>::quiet_NaN()) == expected + "nan, expected a finite number > 0");
  CHECK(testing::message_of([&] { return adaptive_fit<Curve>(Poses{}, all(1)).converged; }) ==
        "fit: 0 poses, expected at least 2");
}
