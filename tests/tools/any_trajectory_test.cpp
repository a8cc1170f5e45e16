// SPDX-License-Identifier: MIT
#include "../../tools/support/any_trajectory.hpp"

#include <splinertia/splinertia.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// A curve that turns and climbs, with a control point every 0.1 s.
template <Pose G>
auto curve() {
  std::vector<G> points;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d turn(0.2 * i, std::sin(0.4 * i), 0.3 * std::cos(0.5 * i));
    points.push_back(make_pose<G>(Sophus::SO3d::exp(turn), Eigen::Vector3d(std::cos(0.3 * i), 0.2 * i, -0.1 * i)));
  }
  using Knots = UniformKnots<nanoseconds>;
  return Spline<G, 5, Knots>(Knots{nanoseconds(1'600'000'000'000'000'000), nanoseconds(100'000'000)}, points);
}

/// What the readings and the true states of two trajectories differ by at most.
double difference(const auto& a, const auto& b) {
  const Imu imu{ErrorModel{RandomWalk{1e-3}}, ErrorModel{WhiteNoise{1e-2}}};
  const auto readings_a = simulate(a, imu, {.rate = 133, .seed = 3});
  const auto readings_b = simulate(b, imu, {.rate = 133, .seed = 3});
  REQUIRE(readings_a.size() == readings_b.size());
  double most = 0;
  auto second = readings_b.begin();
  for (const auto& first : readings_a) {
    REQUIRE(first.time == second->time);
    const auto state_a = nav_state(a.template evaluate<1>(first.time), first.time);
    const auto state_b = nav_state(b.template evaluate<1>(first.time), first.time);
    most = std::max({most, (first.gyro - second->gyro).norm(), (first.accel - second->accel).norm(),
                     increment(state_a.R_WB, state_b.R_WB).norm(), (state_a.p_WB - state_b.p_WB).norm(),
                     (state_a.v_WB - state_b.v_WB).norm()});
    ++second;
  }
  return most;
}

}  // namespace

TEST_CASE("a curve behind AnyTrajectory is simulated as it is, on either group") {
  const auto rigid = curve<Sophus::SE3d>();
  const auto split = curve<SO3xR3<double>>();
  CHECK(difference(rigid, AnyTrajectory(rigid)) < 1e-12);
  CHECK(difference(split, AnyTrajectory(split)) < 1e-12);
  CHECK(difference(rigid, AnyTrajectory(split)) > 1e-2);  // the test can fail
  CHECK(AnyTrajectory(rigid).start() == rigid.start());
  CHECK(AnyTrajectory(rigid).end() == rigid.end());
}

TEST_CASE("the angular acceleration of a rigid motion is the split one's") {
  const auto rigid = curve<Sophus::SE3d>();
  const AnyTrajectory any(rigid);
  const nanoseconds time = rigid.start() + nanoseconds(123'456'789);
  const auto expected = rigid.evaluate<2>(time);
  const auto got = any.evaluate<2>(time);
  static_assert(std::same_as<decltype(got), const Motion<SO3xR3<double>, 2>>);
  CHECK((angular_acceleration(expected) - angular_acceleration(got)).norm() < 1e-12);
}

TEST_CASE("a motion in seconds is bounded and takes nanoseconds") {
  const Ellipse<> ellipse;
  const AnyTrajectory any(ellipse, nanoseconds(0), nanoseconds(2'000'000'000));
  CHECK(any.end() == nanoseconds(2'000'000'000));
  const auto expected = ellipse.evaluate<2>(0.7), got = any.evaluate<2>(nanoseconds(700'000'000));
  CHECK(expected.velocity == got.velocity);
  CHECK(expected.acceleration == got.acceleration);
}
