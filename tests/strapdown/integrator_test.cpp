// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <splinertia/strapdown/schemes/trapezoid.hpp>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>
#include <vector>

#include "strapdown/schemes/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using State = NavState<double>;

bool same(const auto& a, const auto& b) {
  return a.p_WB == b.p_WB && a.v_WB == b.v_WB && a.R_WB.unit_quaternion().coeffs() == b.R_WB.unit_quaternion().coeffs();
}

/// Readings of the aggressive motion of the kind that a scheme takes.
template <typename Scheme>
auto readings(const std::vector<double>& stamps) {
  const testing::AggressiveMotion<> motion;
  if constexpr (Scheme::takes_increments) {
    return testing::increments(motion, stamps);
  } else {
    return testing::point_samples(motion, stamps);
  }
}

State initial() { return nav_state(testing::AggressiveMotion<>{}.evaluate<1>(0), 0.0); }

}  // namespace

TEMPLATE_TEST_CASE("Each step is visited, and the state is the last one", "", Euler, ZeroOrderHold, Midpoint, Trapezoid,
                   RungeKutta4, RungeKutta4DoubleStep, Magnus4, UncorrectedIncrements, RotationCorrectedIncrements,
                   TwoSampleIncrements, ThreeSampleIncrements) {
  for (int n = 3; n <= 10; ++n) {
    std::vector<double> stamps;
    for (int i = 0; i <= n; ++i) stamps.push_back(i / 128.0);
    Integrator<TestType, double> integrator(initial());
    CHECK(same(integrator.state(), initial()));
    std::vector<State> visited;
    const auto visit = [&](const State& state) { visited.push_back(state); };
    for (const auto& reading : readings<TestType>(stamps)) integrator.push(reading, visit);
    integrator.finish(visit);
    const int stride = TestType::stride;
    REQUIRE(visited.size() == static_cast<std::size_t>((n + stride - 1) / stride));
    for (std::size_t i = 0; i < visited.size(); ++i) {
      CHECK(visited[i].time == stamps[std::min((i + 1) * TestType::stride, stamps.size() - 1)]);
    }
    CHECK(integrator.state().time == stamps.back());
    CHECK(same(integrator.state(), visited.back()));
    const auto truth = nav_state(testing::AggressiveMotion<>{}.evaluate<1>(stamps.back()), stamps.back());
    CHECK((integrator.state().p_WB - truth.p_WB).norm() < 0.1);

    Integrator<TestType, double> quiet(initial());
    for (const auto& reading : readings<TestType>(stamps)) quiet.push(reading);
    quiet.finish();
    CHECK(same(quiet.state(), integrator.state()));
  }
}

TEMPLATE_TEST_CASE("Stamps in nanoseconds since an epoch lose nothing", "", Midpoint, Magnus4, RungeKutta4DoubleStep,
                   TwoSampleIncrements, ThreeSampleIncrements) {
  const auto from_zero = readings<TestType>(testing::regular_stamps(200));
  const auto run = [&](nanoseconds epoch) {
    NavState<double, nanoseconds> start{initial().R_WB, initial().v_WB, initial().p_WB, epoch};
    Integrator integrator(TestType{}, start);
    std::int64_t i = TestType::takes_increments ? 1 : 0;
    for (const auto& reading : from_zero) {
      const nanoseconds time = epoch + nanoseconds(5'000'000 * i++);
      if constexpr (TestType::takes_increments) {
        integrator.push(ImuIncrement<double, nanoseconds>{time, reading.delta_angle, reading.delta_velocity});
      } else {
        integrator.push(ImuSample<double, nanoseconds>{time, reading.gyro, reading.accel});
      }
    }
    integrator.finish();
    CHECK(integrator.state().time == epoch + std::chrono::seconds(10));
    return integrator.state();
  };
  const auto state = run(nanoseconds(1'400'000'000'123'456'789));
  CHECK(same(state, run(nanoseconds(0))));

  Integrator<TestType, double> in_seconds(initial());
  for (const auto& reading : from_zero) in_seconds.push(reading);
  in_seconds.finish();
  CHECK((state.p_WB - in_seconds.state().p_WB).norm() < 1e-10);
  CHECK((state.v_WB - in_seconds.state().v_WB).norm() < 1e-11);
  CHECK((state.R_WB.inverse() * in_seconds.state().R_WB).log().norm() < 1e-12);
}

TEST_CASE("A reading that is refused changes nothing, and the next one is taken") {
  const auto samples = readings<Magnus4>(testing::regular_stamps(100));
  Integrator<Magnus4, double> integrator(initial(), standard_gravity<double>(), {.longest = 0.015});
  Integrator<Magnus4, double> undisturbed(initial());
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK_THROWS_AS(integrator.push(samples[i + 2]), std::invalid_argument);  // a gap, or not the first
    integrator.push(samples[i]);
    CHECK_THROWS_AS(integrator.push(samples[i]), std::invalid_argument);
    undisturbed.push(samples[i]);
  }
  CHECK(same(integrator.state(), undisturbed.state()));
  CHECK(integrator.gaps() == 0);
}

TEMPLATE_TEST_CASE("Samples may follow after the end", "", Midpoint, Magnus4, RungeKutta4DoubleStep,
                   TwoSampleIncrements) {
  const auto samples = readings<TestType>(testing::regular_stamps(100));
  Integrator<TestType, double> paused(initial()), whole(initial());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    paused.push(samples[i]);
    whole.push(samples[i]);
    if (i % 7 == 3) {
      paused.finish();
      CHECK(paused.state().time == samples[i].time);
    }
  }
  paused.finish();
  whole.finish();
  CHECK(paused.state().time == whole.state().time);
  // The steps before a pause see less, but no less than those of Midpoint do.
  const auto error = [](const State& state) {
    return (state.p_WB - nav_state(testing::AggressiveMotion<>{}.evaluate<1>(state.time), state.time).p_WB).norm();
  };
  Integrator<Midpoint, double> midpoint(initial());
  for (const auto& sample : readings<Midpoint>(testing::regular_stamps(100))) midpoint.push(sample);
  CHECK(error(paused.state()) <= error(midpoint.state()));
}

TEST_CASE("Free fall is exact, also far from the origin and in float") {
  const auto run = []<typename Scalar>(Scalar) {
    NavState<Scalar> start{{}, {1, 2, 3}, {Scalar(1e9), 0, 0}, Scalar(0)};
    Integrator<Midpoint, Scalar, Scalar> integrator({start.R_WB, start.v_WB, start.p_WB, Scalar(0)}, {0, 0, -10});
    for (int i = 0; i <= 1280; ++i) {
      integrator.push(ImuSample<Scalar, Scalar>{static_cast<Scalar>(i) / 128, {0, 0, 0}, {0, 0, 0}});
    }
    const auto& state = integrator.state();
    const Scalar eps = std::numeric_limits<Scalar>::epsilon();
    CHECK(std::abs(state.v_WB.z() + 97) < 1280 * 97 * eps);
    CHECK(std::abs(state.p_WB.z() + 470) < 1280 * 470 * eps);
    CHECK(std::abs(state.p_WB.x() - Scalar(1e9) - 10) <= 1280 * Scalar(1e9) * eps);
    CHECK(std::abs(state.R_WB.unit_quaternion().norm() - 1) < eps);
  };
  run(double());
  run(float());
}

TEST_CASE("The frame that does nothing has no size") {
  struct WithoutFrame {
    State state;
    Eigen::Vector3d gravity;
    SampleWindow<Midpoint, double, double> window;
  };
  STATIC_CHECK(std::is_empty_v<InertialFrame>);
  STATIC_CHECK(sizeof(Integrator<Midpoint, double>) == sizeof(WithoutFrame));
}
