// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <ranges>
#include <splinertia/imu/random_walk.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/imu/white_noise.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {
const Imu noisy{ErrorModel{WhiteNoise{0.015}, RandomWalk{5e-5}}, ErrorModel{WhiteNoise{0.019}, RandomWalk{5e-4}}};
const Imu ideal{ErrorModel{}, ErrorModel{}};
}  // namespace

TEST_CASE("Without error terms a sample is the ideal measurement") {
  const Ellipse<> motion;
  std::size_t i = 0;
  for (const ImuReading& r : simulate(motion, ideal, {.rate = 100, .start = 2.0, .end = 3.0})) {
    CHECK(r.time == 2.0 + static_cast<double>(i++) / 100);
    const auto expected = ideal_imu(motion.evaluate<2>(r.time));
    CHECK(r.gyro == expected.gyro);
    CHECK(r.accel == expected.accel);
    CHECK(r.gyro_bias.isZero(0));
  }
  CHECK(i == 101);
}

TEST_CASE("With density 0.015 at 200 Hz the samples deviate by 0.2121") {
  double squares = 0;
  double count = 0;
  for (const auto& r :
       simulate(at_rest(SO3xR3<double>{}), noisy, {.rate = 200, .seed = 42, .start = 0.0, .end = 500.0})) {
    squares += (r.gyro - r.gyro_bias).squaredNorm();
    count += 3;
  }
  const double expected = 0.015 * std::sqrt(200.0);
  CHECK_THAT(expected, WithinAbs(0.2121, 5e-5));
  CHECK(std::abs(std::sqrt(squares / count) - expected) < 4 * expected / std::sqrt(2 * count));
}

TEST_CASE("The bias reported is the one in the sample") {
  const Imu walk{ErrorModel{RandomWalk{0.1}}, ErrorModel{RandomWalk{0.2}}};
  for (const auto& r : simulate(at_rest(SO3xR3<double>{}), walk, {.rate = 50, .seed = 1, .start = 0.0, .end = 2.0})) {
    CHECK(r.gyro == r.gyro_bias);
    CHECK((r.accel - Eigen::Vector3d(0, 0, 9.80665) - r.accel_bias).norm() < 1e-15 * 10);
  }
}

TEST_CASE("A run can be repeated, and one sensor does not change the other") {
  const Ellipse<> motion;
  const auto gyros = [&](const auto& imu, std::uint64_t seed) {
    std::vector<Eigen::Vector3d> values;
    for (const auto& r : simulate(motion, imu, {.seed = seed, .start = 0.0, .end = 1.0})) values.push_back(r.gyro);
    return values;
  };
  CHECK(gyros(noisy, 1) == gyros(noisy, 1));
  CHECK(gyros(noisy, 1) != gyros(noisy, 2));
  CHECK(gyros(noisy, 1) == gyros(Imu{noisy.gyro, ErrorModel{}}, 1));

  const auto run = simulate(motion, noisy, {.seed = 1, .start = 0.0, .end = 1.0});
  CHECK(run.begin()->gyro == run.begin()->gyro);  // begin() begins anew
  CHECK(std::ranges::input_range<decltype(run)>);
}

TEST_CASE("Both ends of a spline are sampled where a sample falls on them") {
  testing::Random random(1);
  const Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>> curve(
      {nanoseconds{1'403'715'524'907'143'168}, nanoseconds{100'000'000}}, random.walk<SO3xR3<double>>(13));
  std::vector<nanoseconds> times;
  const auto run = simulate(curve, ideal, {.rate = 200});
  for (const auto& r : run) times.push_back(r.time);
  CHECK(times.size() == 201);
  CHECK(run.size() == 201);
  CHECK(times.front() == curve.start());
  CHECK(times.back() == curve.end());
  CHECK(times[1] - times[0] == nanoseconds{5'000'000});
}

TEST_CASE("A temporary motion is kept for as long as the samples") {
  double last = -1;
  for (const auto& r : simulate(Ellipse<>{}, ideal, {.rate = 10, .start = 0.0, .end = 1.0})) last = r.time;
  CHECK(last == 1);
}

TEST_CASE("Float works throughout") {
  const Imu imu{ErrorModel{WhiteNoise{0.015F}}, ErrorModel{RandomWalk{0.1F}}};
  std::size_t n = 0;
  for (const auto& r : simulate(Ellipse<float>{}, imu, {.rate = 100, .start = 0.0F, .end = 1.0F})) {
    CHECK(r.gyro.allFinite());
    ++n;
  }
  CHECK(n == 101);
}

TEST_CASE("A run that cannot be is refused") {
  const Ellipse<> motion;
  CHECK_THROWS_WITH(simulate(motion, ideal, {.rate = -5, .start = 0.0, .end = 1.0}),
                    "simulate: rate is -5 Hz, expected a positive finite number");
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = std::nan(""), .start = 0.0, .end = 1.0}), std::invalid_argument);
  CHECK_THROWS_WITH(simulate(motion, ideal, {.rate = 10}),
                    "simulate: the motion has no bounds, expected options .start and .end");
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = 10, .start = 1.0, .end = 0.0}), std::invalid_argument);
  testing::Random random(1);
  const Spline<SO3xR3<double>, 4> curve({.start = 0, .interval = 1}, random.walk<SO3xR3<double>>(6));
  CHECK_THROWS_WITH(simulate(curve, ideal, {.rate = 10, .start = -1.0}),
                    "simulate: samples wanted from -1 to 3, the motion is defined from 0 to 3");
}
