// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/choose_knots.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "strapdown/aggressive_motion.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using testing::message_of;

namespace {

using G = SO3xR3<double>;
using Curve = Spline<G, 4>;
using Poses = std::vector<Stamped<G, double>>;

constexpr testing::AggressiveMotion<> motion{.speed = 0.3};

/// 5 s at 100 Hz, with white noise of `noise` rad and twice as many m.
Poses poses_with_noise(double noise, std::uint64_t seed = 1) {
  NormalStream normal{StreamKey(seed)};
  Poses poses;
  for (int i = 0; i <= 500; ++i) {
    const auto value = motion.evaluate<0>(0.01 * i).value;
    Tangent<G> error;
    for (double& x : error) x = noise * normal();
    error.tail<3>() *= 2;
    poses.push_back({0.01 * i, GroupTraits<G>::compose(value, GroupTraits<G>::exp(error))});
  }
  return poses;
}

Tangent<G> goal_of(double rotation) {
  Tangent<G> goal;
  goal << rotation, rotation, rotation, 2 * rotation, 2 * rotation, 2 * rotation;
  return goal;
}

/// Residuals over the goal of a fit with this interval: the largest of the components' RMS.
double over_goal(const Poses& poses, double interval, const Tangent<G>& goal) {
  return fit<Curve>(poses, {.knot_interval = interval}).residuals.component_rms.cwiseQuotient(goal).maxCoeff();
}

/// The RMS distance of a fit with this interval from the motion without noise: of positions in units of 2 m.
double true_error(const Poses& poses, double interval) {
  const auto curve = fit<Curve>(poses, {.knot_interval = interval}).spline;
  double squares = 0;
  for (const auto& [time, value] : poses) {
    const Tangent<G> r = increment<G>(motion.evaluate<0>(time).value, curve.evaluate<0>(time).value);
    squares += r.head<3>().squaredNorm() + r.tail<3>().squaredNorm() / 4;
  }
  return std::sqrt(squares / (6 * static_cast<double>(poses.size())));
}

/// Every 25th pose is somewhere else.
void add_jumps(Poses& poses) {
  for (std::size_t i = 10; i < poses.size(); i += 25) {
    Tangent<G> jump;
    jump << 0.2, -0.3, 0.1, 0.5, 0.4, -0.6;
    poses[i].value = GroupTraits<G>::compose(poses[i].value, GroupTraits<G>::exp(jump));
  }
}

}  // namespace

TEST_CASE("The coarsest interval meets the goal, and not much longer ones do") {
  const auto poses = poses_with_noise(0);
  double before = std::numeric_limits<double>::infinity();
  for (const double rotation : {1e-2, 1e-3, 1e-5}) {
    const auto goal = goal_of(rotation);
    const double interval = coarsest_knot_interval<Curve>(poses, goal);
    INFO("goal " << rotation << " rad, interval " << interval << " s");
    CHECK(over_goal(poses, interval, goal) <= 1);
    CHECK(over_goal(poses, 1.3 * interval, goal) > 1);
    CHECK(interval < before);
    before = interval;
  }
}

TEST_CASE("With noise and a goal a little above it, the curve is nearer to the truth than the poses") {
  const double noise = 0.01;
  const auto poses = poses_with_noise(noise);
  const auto goal = goal_of(1.1 * noise);
  const double interval = coarsest_knot_interval<Curve>(poses, goal);
  CHECK(over_goal(poses, interval, goal) <= 1);
  CHECK(over_goal(poses, 1.3 * interval, goal) > 1);
  CHECK(true_error(poses, interval) < 0.5 * noise);  // 1.1² is 1 + 0.46²
}

TEST_CASE("Jumps do not make the interval shorter where the loss is robust") {
  const auto goal = goal_of(0.011);
  auto poses = poses_with_noise(0.01);
  const double without = coarsest_knot_interval<Curve>(poses, goal);
  add_jumps(poses);
  for (const auto& loss : {RobustLoss::huber(), RobustLoss::cauchy()}) {
    const double with = coarsest_knot_interval<Curve>(poses, goal, {.loss = loss});
    INFO(with << " s with jumps, " << without << " s without");
    CHECK(with > without / 1.2);
    CHECK(with < without * 1.2);
  }
  CHECK(coarsest_knot_interval<Curve>(poses, goal_of(0.015)) < without / 4);  // with squares they do
}

TEST_CASE("A goal that cannot be reached, or is none, is an error") {
  const auto poses = poses_with_noise(0.01);
  const auto unreachable = [&](const FitOptions<Curve>& options) -> std::string {
    try {
      return std::to_string(coarsest_knot_interval<Curve>(poses, goal_of(1e-8), options));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  const auto message = unreachable({});
  CHECK(message.starts_with("coarsest_knot_interval: even with knots 0.01004"));
  CHECK(message.find(" s apart, one control point per pose, the RMS residuals are up to ") != std::string::npos);
  CHECK(message.ends_with(" times the goal"));
  // Poses that all are far from the goal are not taken for outliers.
  CHECK(unreachable({.loss = RobustLoss::cauchy()}) == message);

  const auto refusal = [&](double component) {
    auto goal = goal_of(0.1);
    goal[4] = component;
    return message_of([&] { return coarsest_knot_interval<Curve>(poses, goal); });
  };
  const std::string of_the_goal = "coarsest_knot_interval: component 4 of the goal is ";
  CHECK(refusal(0) == of_the_goal + "0, expected a finite number > 0");
  CHECK(refusal(-1) == of_the_goal + "-1, expected a finite number > 0");
  CHECK(refusal(std::numeric_limits<double>::quiet_NaN()) == of_the_goal + "nan, expected a finite number > 0");
  CHECK(refusal(std::numeric_limits<double>::infinity()) == of_the_goal + "inf, expected a finite number > 0");

  const Poses none;
  CHECK(message_of([&] { return coarsest_knot_interval<Curve>(none, goal_of(1)); }) ==
        "fit: 0 poses, expected at least 2");
  CHECK(message_of([&] { return cross_validated_knot_interval<Curve>(none).knot_interval; }) ==
        "fit: 0 poses, expected at least 2");
}

TEST_CASE("Cross-validation finds the interval that is nearest to the truth") {
  for (const double noise : {0.002, 0.02}) {
    for (const bool jumps : {false, true}) {
      INFO("noise " << noise << (jumps ? ", with jumps" : ""));
      const auto clean = poses_with_noise(noise, 3);
      auto poses = clean;
      if (jumps) add_jumps(poses);
      const auto found =
          cross_validated_knot_interval<Curve>(poses, {.loss = jumps ? RobustLoss::cauchy() : RobustLoss::squares()});
      double best = std::numeric_limits<double>::infinity(), least = best;
      double before = 5.01;
      bool is_there = false;
      for (const auto& [interval, error] : found.tried) {
        CHECK(interval < before);
        CHECK(interval > before / 2.1);
        before = interval;
        CHECK(error > 0.5 * noise);  // poses left out are noisy, too
        best = std::min(best, true_error(clean, interval));
        least = std::min(least, error);
        is_there = is_there || interval == found.knot_interval;
      }
      CHECK(is_there);
      CHECK(found.tried.size() > 5);
      // The geometric mean over components of 1 and 2 times the noise is √2 times it.
      CHECK_THAT(least, WithinRel(std::sqrt(2.0) * noise, 0.2));
      INFO("interval " << found.knot_interval << ", error " << true_error(clean, found.knot_interval) << ", best "
                       << best);
      CHECK(true_error(clean, found.knot_interval) <= 1.3 * best);
      CHECK(true_error(clean, found.knot_interval) < 0.5 * noise);
    }
  }
}

TEST_CASE("Components that never move leave the choice to the others") {
  // On a plane at 1 m, turning about the vertical: of six components, three are rounding.
  NormalStream normal{StreamKey(5)};
  std::vector<Stamped<G, double>> poses;
  std::vector<Stamped<Eigen::Vector3d, double>> moving;
  for (int i = 0; i <= 500; ++i) {
    const double t = 0.01 * i;
    const double yaw = std::sin(3 * t) + 0.01 * normal(), x = std::sin(4 * t) + 0.01 * normal(),
                 y = std::cos(5 * t) + 0.01 * normal();
    poses.push_back({t, {Sophus::SO3d::rotZ(yaw), Eigen::Vector3d(x, y, 1)}});
    moving.push_back({t, {yaw, x, y}});
  }
  const auto found = cross_validated_knot_interval<Curve>(poses);
  const auto expected = cross_validated_knot_interval<Spline<Eigen::Vector3d, 4>>(moving);
  CHECK(found.knot_interval == expected.knot_interval);
  // The search may go on a little longer, since the mean changes less.
  REQUIRE(found.tried.size() >= expected.tried.size());
  const std::size_t last = expected.tried.size() - 1;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < last; ++i) {
    // With knots so far apart, increments are beyond half a turn, where an angle is not a number.
    if (expected.tried[i].knot_interval > 0.25) continue;
    // Geometric means, of which half of the components are alike: the root of the ratio.
    CHECK_THAT(std::pow(found.tried[i].error / found.tried[last].error, 2),
               WithinRel(expected.tried[i].error / expected.tried[last].error, 1e-6));
    ++compared;
  }
  CHECK(compared >= 3);
}
