// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/message.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/rotating_frame.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <splinertia/strapdown/schemes/trapezoid.hpp>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {
const Imu ideal{ErrorModel{}, ErrorModel{}};

struct Row {  // the least that a sample has to be
  double time;
  Eigen::Vector3d gyro, accel;
};
}  // namespace

TEMPLATE_TEST_CASE("The largest readings that are taken give finite states, larger ones are refused", "", Midpoint,
                   Magnus4, Trapezoid, RungeKutta4, RungeKutta4DoubleStep) {
  const auto run = []<typename Scalar>(Scalar reading, bool both) {
    std::vector<ImuSample<Scalar, double>> rows;
    for (int i = 0; i < 6; ++i) {
      const Scalar x = i % 2 == 0 || both ? reading : -reading;
      rows.push_back({0.25 * i, {x, x, 0}, {x, 0, x}});
    }
    return integrate<TestType>(NavState<Scalar, double>{{}, {0, 0, 0}, {0, 0, 0}, 0}, rows).back();
  };
  const auto check = [&]<typename Scalar>(Scalar most) {
    for (const bool both : {false, true}) {
      const auto state = run(most, both);
      CHECK(all_finite(state.R_WB.unit_quaternion().coeffs()));
      CHECK(all_finite(state.v_WB));
      CHECK(all_finite(state.p_WB));
      CHECK_THROWS_AS(run(2 * most, both), std::invalid_argument);
    }
  };
  check(std::ldexp(1.0, 341));  // the third power is below 2^1024
  check(std::ldexp(1.0F, 42));
  if constexpr (std::same_as<TestType, Midpoint>) {
    CHECK_THROWS_WITH(run(1e200, true), Catch::Matchers::StartsWith(
                                            "integrate: sample 0 at 0 has gyro[0] = 1e+200, expected at most 4.47") &&
                                            Catch::Matchers::EndsWith("e+102 in magnitude"));
  }
}

TEMPLATE_TEST_CASE("A body at rest stays where it is", "", Euler, Midpoint) {
  testing::Random random(1);
  const auto rest = at_rest(random.walk<SO3xR3<double>>(1)[0]);
  const auto initial = nav_state(rest.evaluate<1>(0), 0.0);
  const auto states = integrate<TestType>(initial, simulate(rest, ideal, {.rate = 200, .start = 0.0, .end = 10.0}));
  REQUIRE(states.size() == 2001);
  CHECK(states.back().time == 10);
  CHECK(increment(states.back().R_WB, initial.R_WB).norm() < 1e-15);
  // Gravity is taken away again with an error of one rounding, 2e-15 m/s², which is integrated twice over 10 s.
  CHECK((states.back().v_WB - initial.v_WB).norm() < 2e-14);
  CHECK((states.back().p_WB - initial.p_WB).norm() < 1e-13);
}

TEMPLATE_TEST_CASE("A constant rate gives the exact attitude", "", Euler, Midpoint) {
  testing::Random random(2);
  const ConstantTwist<SO3xR3<double>> motion{random.walk<SO3xR3<double>>(1)[0], random.tangent<SO3xR3<double>>(2)};
  const auto states = integrate<TestType>(nav_state(motion.evaluate<1>(0), 0.0),
                                          simulate(motion, ideal, {.rate = 100, .start = 0.0, .end = 10.0}));
  for (std::size_t i = 0; i < states.size(); i += 100) {
    CHECK(increment(rotation(motion.evaluate<0>(states[i].time).value), states[i].R_WB).norm() < 1e-13);
  }
}

TEST_CASE("A constant screw about the vertical is reproduced to rounding") {
  // Its acceleration is zero in the world, and the force R^T g is the same at both ends of each step.
  ConstantTwist<Sophus::SE3d> screw;
  screw.twist << 0, 0, 0.7, 0, 0, 3;
  const auto states = integrate<Midpoint>(nav_state(screw.evaluate<1>(0), 0.0),
                                          simulate(screw, ideal, {.rate = 100, .start = 0.0, .end = 10.0}));
  const auto truth = screw.evaluate<1>(10);
  CHECK((states.back().p_WB - position(truth.value)).norm() < 1e-12);
  CHECK((states.back().v_WB - world_velocity(truth)).norm() < 1e-13);
}

TEST_CASE("Any struct with time, gyro and accel is a sample, and intervals may differ") {
  const Eigen::Vector3d g(0, 0, -10);
  const std::array<Row, 3> rows{Row{1, {0, 0, 0}, {1, 0, 10}}, Row{1.5, {0, 0, 0}, {1, 0, 10}},
                                Row{3, {0, 0, 0}, {1, 0, 10}}};
  const auto states = integrate<Midpoint>(NavState<double>{{}, {0, 2, 0}, {0, 0, 5}, 1}, rows, g);
  REQUIRE(states.size() == 3);
  CHECK((states[2].v_WB - Eigen::Vector3d(2, 2, 0)).norm() < 1e-14);
  CHECK((states[2].p_WB - Eigen::Vector3d(2, 4, 5)).norm() < 1e-14);
}

TEST_CASE("No samples give no states, and one gives the initial one") {
  const NavState<double> initial{{}, {1, 2, 3}, {4, 5, 6}, 7};
  CHECK(integrate<Euler>(initial, std::vector<Row>{}).empty());
  CHECK(integrate<Magnus4>(initial, std::vector<Row>{}).empty());
  const auto states = integrate<Magnus4>(initial, std::vector{Row{7, {0, 0, 0}, {0, 0, 0}}});
  REQUIRE(states.size() == 1);
  CHECK(states[0].p_WB == initial.p_WB);
}

TEST_CASE("Visiting the states keeps none of them, and they are the same") {
  const Ellipse<> motion;
  const auto initial = nav_state(motion.evaluate<1>(0), 0.0);
  const auto samples = simulate(motion, ideal, {.rate = 100, .start = 0.0, .end = 1.0});
  const auto states = integrate<Magnus4>(initial, samples);
  REQUIRE(states.size() == 101);
  std::size_t i = 0;
  integrate<Magnus4>(initial, samples, standard_gravity<double>(), [&](const NavState<double>& state) {
    CHECK(state.time == states[i].time);
    CHECK(state.p_WB == states[i].p_WB);
    ++i;
  });
  CHECK(i == states.size());
}

TEST_CASE("Gaps are refused or bridged, and the frame may turn") {
  const NavState<double> initial{{}, {0, 0, 0}, {0, 0, 0}, 0};
  const auto at = [](double t) { return Row{t, {0, 0, 0}, {0, 0, 10}}; };
  const std::vector rows{at(0), at(1), at(3), at(4)};
  const Eigen::Vector3d g(0, 0, -10);
  CHECK_THROWS_WITH(integrate<Midpoint>(initial, rows, g, {.gaps = {.longest = 1}}),
                    "integrate: sample 2 at 3 comes 2 s after the one before, expected at most 1 s");
  std::size_t bridged = 7;
  const auto states = integrate<Midpoint>(
      initial, rows, g, {.gaps = {.longest = 1, .policy = GapPolicy::bridge}, .bridged_gaps = &bridged});
  CHECK(bridged == 1);
  CHECK(states.size() == 4);
  CHECK(states.back().p_WB == Eigen::Vector3d(0, 0, 0));

  const IntegrationOptions<double, RotatingFrame<double>> turning{.frame = {{0, 0, 0.1}}};
  const auto turned = integrate<Midpoint>(initial, rows, g, turning);
  CHECK((turned.back().R_WB.log() - Eigen::Vector3d(0, 0, -0.4)).norm() < 1e-15);
}

TEST_CASE("Samples that do not follow each other or the state are refused") {
  const NavState<double> initial{{}, {0, 0, 0}, {0, 0, 0}, 1};
  const auto at = [](double t) { return Row{t, {0, 0, 0}, {0, 0, 0}}; };
  CHECK_THROWS_WITH(integrate<Euler>(initial, std::vector{at(2), at(3)}),
                    "integrate: the first sample is at 2, the initial state at 1, expected the same time");
  CHECK_THROWS_WITH(integrate<Euler>(initial, std::vector{at(1), at(2), at(2)}),
                    "integrate: sample 2 is at 2, expected a time after 2");
  CHECK_THROWS_AS(integrate<Euler>(initial, std::vector{at(1), at(std::nan(""))}), std::invalid_argument);
}

TEST_CASE("Readings, states and gravity that are not finite are refused") {
  const double nan = std::nan("");
  const NavState<double> initial{{}, {0, 0, 0}, {0, 0, 0}, 1};
  const auto at = [](double t, double force) { return Row{t, {0, 0, 0}, {force, 0, 0}}; };
  CHECK_THROWS_WITH(integrate<Midpoint>(initial, std::vector{at(1, 0), at(2, nan), at(3, 0)}),
                    "integrate: sample 1 at 2 has accel[0] = nan, expected a finite number");
  CHECK_THROWS_WITH(integrate<Midpoint>(NavState<double>{{}, {0, nan, 0}, {0, 0, 0}, 1}, std::vector{at(1, 0)}),
                    "integrate: the initial velocity[1] is nan, expected a finite number");
  CHECK_THROWS_WITH(integrate<Midpoint>(NavState<double>{{}, {0, 0, 0}, {0, 0, nan}, 1}, std::vector{at(1, 0)}),
                    "integrate: the initial position[2] is nan, expected a finite number");
  CHECK_THROWS_WITH(integrate<Midpoint>(initial, std::vector{at(1, 0)}, {0, 0, nan}),
                    "integrate: gravity[2] is nan, expected a finite number");
  for (const double x : {nan, std::numeric_limits<double>::infinity()}) {
    const NavState<double> never{{}, {0, 0, 0}, {0, 0, 0}, x};
    CHECK_THROWS_WITH(integrate<Midpoint>(never, std::vector<Row>{}),
                      "integrate: the initial time is " + message(x) + ", expected a finite number");
    CHECK_THROWS_AS(integrate<Midpoint>(never, std::vector{at(x, 0)}), std::invalid_argument);
  }
  const IntegrationOptions<double, RotatingFrame<double>> turning{.frame = {{0, 0, nan}}};
  CHECK_THROWS_AS(integrate<Midpoint>(initial, std::vector{at(1, 0)}, {0, 0, 0}, turning), std::invalid_argument);
}

TEMPLATE_TEST_CASE("A body at rest stays where it is on two or three samples", "", Midpoint, Magnus4) {
  const NavState<double> initial{{}, {0, 0, 0}, {1, 2, 3}, 0};
  for (int n = 2; n <= 3; ++n) {
    std::vector<Row> rows;
    for (int i = 0; i < n; ++i) rows.push_back({0.25 * i, {0, 0, 0}, {0, 0, 10}});
    const auto states = integrate<TestType>(initial, rows, {0, 0, -10});
    REQUIRE(states.size() == rows.size());
    CHECK((states.back().p_WB - initial.p_WB).norm() < 1e-15);
  }
}
