// SPDX-License-Identifier: MIT
#include <chrono>
#include <splinertia/imu/imu_noise.hpp>
#include <splinertia/imu/presets.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/imu/to_vector.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrator.hpp>
#include <splinertia/strapdown/preintegration/preintegrate.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

TEST_CASE("preintegrate is a Preintegrator over a range, at no loss") {
  const Ellipse<> motion;
  const auto samples = simulate(motion, presets::euroc, {.rate = 200, .seed = 2, .start = 1.0, .end = 2.0});
  const ImuBias<> bias{{0.01, -0.02, 0.03}, {0.1, 0.2, -0.15}};
  const ImuNoise noise = imu_noise(presets::euroc);
  Preintegrator preintegrator(Midpoint{}, 1.0, bias, noise);
  STATIC_CHECK(std::is_same_v<decltype(preintegrator), Preintegrator<Midpoint, double, double, ImuNoise<double>>>);
  for (const auto& sample : samples) preintegrator.push(sample);
  preintegrator.finish();
  const auto expected = preintegrator.result();

  for (const auto& result :
       {preintegrate<Midpoint>(samples, bias, noise), preintegrate<Midpoint>(1.0, samples, bias, noise),
        preintegrate<Midpoint>(to_vector<ImuSample<>>(samples), bias, noise)}) {
    CHECK(result.delta().rotation.coeffs() == expected.delta().rotation.coeffs());
    CHECK(result.delta().velocity == expected.delta().velocity);
    CHECK(result.delta().position == expected.delta().position);
    CHECK(result.delta().interval == expected.delta().interval);
    CHECK(result.bias().gyro == bias.gyro);
    CHECK(result.covariance().matrix() == expected.covariance().matrix());
  }
  const auto without = preintegrate<Midpoint>(samples);
  STATIC_CHECK(std::is_same_v<decltype(without), const PreintegratedImu<double, NoCovariance>>);
  CHECK(without.bias().gyro.isZero(0));
}

TEST_CASE("Increments begin at the start that is given") {
  const std::vector<ImuIncrement<float, nanoseconds>> increments{{nanoseconds(500'000'000), {0, 0, 0.1F}, {1, 0, 0}},
                                                                 {nanoseconds(1'000'000'000), {0, 0, 0.1F}, {1, 0, 0}}};
  const auto motion = preintegrate<RotationCorrectedIncrements>(nanoseconds(0), increments, {{0, 0, 0.2F}, {0, 0, 0}});
  STATIC_CHECK(std::is_same_v<decltype(motion), const PreintegratedImu<float, NoCovariance>>);
  CHECK(motion.delta().interval == 1);
  CHECK(motion.delta().rotation.vec().norm() < 1e-7F);  // the bias takes all of it
  CHECK(motion.delta().velocity.x() == Approx(2));
}

TEST_CASE("No samples, and samples that do not begin at the start, are refused") {
  CHECK(testing::message_of([] { return preintegrate<Midpoint>(std::vector<ImuSample<>>{}); }) ==
        "preintegrate: no samples, expected at least one");
  const std::vector<ImuSample<>> samples{{1, {0, 0, 0}, {0, 0, 9.8}}, {2, {0, 0, 0}, {0, 0, 9.8}}};
  CHECK_THROWS_AS(preintegrate<Midpoint>(0.5, samples), std::invalid_argument);
  CHECK_THROWS_AS(preintegrate<Midpoint>(samples, {}, Noiseless{}, {.longest = 0.5}), std::invalid_argument);
}

TEST_CASE("An integrator's types come from its scheme and its state") {
  const NavState<float, nanoseconds> start{Sophus::SO3f(), {0, 0, 0}, {0, 0, 0}, nanoseconds(0)};
  Integrator integrator(Midpoint{}, start, {0, 0, -9.8F});
  STATIC_CHECK(std::is_same_v<decltype(integrator), Integrator<Midpoint, float, nanoseconds>>);
  integrator.push(ImuSample<float, nanoseconds>{nanoseconds(0), {0, 0, 0}, {0, 0, 9.8F}});
  integrator.push(ImuSample<float, nanoseconds>{nanoseconds(10), {0, 0, 0}, {0, 0, 9.8F}});
  CHECK(integrator.state().time == nanoseconds(10));
  Integrator<Midpoint> in_double(nav_state(Ellipse<>{}.evaluate<1>(0.0), 0.0));
  STATIC_CHECK(std::is_same_v<decltype(in_double), Integrator<Midpoint, double, double>>);
}
