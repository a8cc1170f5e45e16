// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <random>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/clock/stamp_jitter.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/sensor_errors.hpp>
#include <splinertia/imu/imu_errors.hpp>
#include <type_traits>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

TEST_CASE("A sensor of one axis takes and gives numbers") {
  SensorErrors wheel(ErrorModel{ConstantBias{0.5}}, StreamKey(1) / "wheel");
  STATIC_CHECK(std::is_same_v<decltype(wheel)::Value, double>);
  const auto reading = wheel.apply(3.0, 2.0, 0.1);
  REQUIRE(reading);
  CHECK(reading->time == 3);
  CHECK(reading->value == 2.5);
  CHECK(reading->bias == 0.5);
}

TEST_CASE("A sensor of several axes takes and gives vectors") {
  auto pixel = sensor_errors<2>(ErrorModel{ConstantBias{PerAxis(1, 2)}}, StreamKey(1) / "pixel");
  const auto reading = pixel.apply(0, {10, 20}, 0.1);
  CHECK(reading->value == Eigen::Vector2d(11, 22));
  CHECK(reading->bias == Eigen::Vector2d(1, 2));
  auto single = sensor_errors<2, float, nanoseconds>(ErrorModel{ConstantBias{1.0F}}, StreamKey(1));
  CHECK(single.apply(nanoseconds(5), {10, 20}, 0.1F)->value == Eigen::Vector2f(11, 21));
  CHECK(single.apply(nanoseconds(9), {10, 20}, 0.1F)->time == nanoseconds(9));
}

TEST_CASE("Only a sensor whose stamps have errors tells true times") {
  const ErrorModel model{WhiteNoise{0.1}};
  SensorErrors plain(model, StreamKey(1));
  SensorErrors stamped(model, ErrorModel{ClockOffset{0.25}}, StreamKey(1));
  const auto has_true_time = []<typename R>(const R&) { return requires(R r) { r.true_time; }; };
  CHECK_FALSE(has_true_time(decltype(plain)::Reading{}));
  const auto reading = stamped.apply(1, 0, 0.1);
  CHECK(reading->time == 1.25);
  CHECK(reading->true_time == 1);
  CHECK(reading->value == plain.apply(1, 0, 0.1)->value);  // the same key, the same errors
}

TEST_CASE("Samples that are dropped leave those that arrive as they were; stamps increase") {
  const ErrorModel model{RandomWalk{0.1}, WhiteNoise{0.1}};
  SensorErrors all(model, ErrorModel{StampJitter{1.0}}, StreamKey(2));
  SensorErrors some(model, ErrorModel{StampJitter{1.0}, DroppedSamples{0.3}}, StreamKey(2));
  int dropped = 0;
  double last = -100;
  for (int i = 0; i < 1000; ++i) {
    const auto one = all.apply(i * 0.1, 5, 0.1), other = some.apply(i * 0.1, 5, 0.1);
    REQUIRE(one->time > last);
    last = one->time;
    dropped += !other;
    if (other) REQUIRE((other->value == one->value && other->bias == one->bias && other->time == one->time));
  }
  CHECK(dropped > 240);  // four standard deviations of 14.5
  CHECK(dropped < 360);
}

TEST_CASE("Elapsed time counts from the first sample, and noise has each interval's size") {
  SensorErrors ramp(ErrorModel{RateRamp{2}}, StreamKey(1));
  CHECK(ramp.apply(100, 0, 1)->value == 0);
  CHECK(ramp.apply(100.5, 0, 0.5)->value == 1);
  SensorErrors one(ErrorModel{WhiteNoise{0.1}}, StreamKey(1)), other(ErrorModel{WhiteNoise{0.1}}, StreamKey(1));
  for (int i = 0; i < 10; ++i) CHECK(std::abs(one.apply(i, 0, 1)->value - other.apply(i, 0, 0.25)->value / 2) < 1e-15);
}

TEST_CASE("A run can be copied; other keys and generators give other numbers") {
  const ErrorModel model{RandomWalk{0.1}, WhiteNoise{0.1}};
  SensorErrors errors(model, StreamKey(1) / "a"), another(model, StreamKey(1) / "b");
  auto twister = sensor_errors<1, double, double, std::mt19937_64>(model, StreamKey(1) / "a");
  static_cast<void>(errors.apply(0, 0, 0.1));
  auto copy = errors;
  const double value = errors.apply(1, 0, 0.1)->value;
  CHECK(copy.apply(1, 0, 0.1)->value == value);
  static_cast<void>(another.apply(0, 0, 0.1));
  static_cast<void>(twister.apply(0, 0, 0.1));
  CHECK(another.apply(1, 0, 0.1)->value != value);
  CHECK(twister.apply(1, 0, 0.1)->value != value);
}

TEST_CASE("A stamp beyond all numbers is refused") {
  SensorErrors errors(ErrorModel{}, ErrorModel{ClockOffset{1e308}, ClockOffset{1e308}}, StreamKey(1));
  CHECK_THROWS_WITH(errors.apply(0, 0, 0.1), "SensorErrors: stamp is inf, expected a finite number");
}

TEST_CASE("Without clock errors a stamp is the time, in any order and even if it is no number") {
  SensorErrors errors(ErrorModel{ConstantBias{1}}, StreamKey(1));
  for (const double time : {2.0, 1.0, 1.0}) CHECK(errors.apply(time, 5, 0.1)->time == time);
  const auto reading = errors.apply(std::nan(""), 5, 0.1);
  CHECK(std::isnan(reading->time));
  CHECK(reading->value == 6);
}

TEST_CASE("Nanoseconds of a run may be as far apart as their type can count") {
  auto ramp = sensor_errors<1, double, nanoseconds>(ErrorModel{RateRamp{1}}, StreamKey(1));
  CHECK(ramp.apply(nanoseconds::min(), 0, 1)->value == 0);
  CHECK(ramp.apply(nanoseconds(-1), 0, 1)->value == Approx(9223372036.854775807));
}

TEST_CASE("Three axes have the errors of the model, and the stamps that an IMU of the same key has") {
  const ErrorModel model{RandomWalk{0.1}, WhiteNoise{0.2}};
  const ErrorModel stamps{StampJitter{1e-3}, DroppedSamples{0.1}};
  const Imu imu{model, ErrorModel{}, stamps};
  ImuErrors<decltype(imu), double, double> of_imu(imu, StreamKey(4));
  auto state = model.start(StreamKey(4) / "value");
  auto sensor = sensor_errors<3>(model, stamps, StreamKey(4));
  decltype(of_imu)::Reading reading{};
  for (int i = 0; i < 200; ++i) {
    const bool arrived = of_imu.apply(i, {{1, 2, 3}, {0, 0, 0}}, 1, reading);
    const auto other = sensor.apply(i, {1, 2, 3}, 1);
    SensorSample<double> sample{{1, 2, 3}, {0, 0, 0}, 1, i == 0, static_cast<double>(i)};
    model.apply(sample, state);
    REQUIRE(arrived == other.has_value());
    if (arrived) REQUIRE((other->time == reading.time && other->value == sample.value && other->bias == sample.bias));
  }
}
