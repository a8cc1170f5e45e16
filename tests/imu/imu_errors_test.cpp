// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <random>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/bias/turn_on_bias.hpp>
#include <splinertia/errors/clock/clock_drift.hpp>
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/clock/stamp_jitter.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/imu_errors.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

const ImuMeasurement<double> ideal{{1, 2, 3}, {4, 5, 6}};

template <typename Time = double, BitGenerator Generator = Xoshiro256, typename Sensors>
auto errors_of(const Sensors& imu, std::uint64_t seed = 1) {
  return ImuErrors<Sensors, double, Time, Generator>(imu, StreamKey(seed));
}

/// The readings that arrive of `count` samples at `rate`, from `start` on.
template <typename Time = double, BitGenerator Generator = Xoshiro256, typename Sensors>
auto readings_of(const Sensors& imu, int count, double rate = 200, Time start = Time(0), std::uint64_t seed = 1) {
  auto errors = errors_of<Time, Generator>(imu, seed);
  std::vector<typename decltype(errors)::Reading> readings;
  for (int i = 0; i < count; ++i) {
    typename decltype(errors)::Reading reading;
    if (errors.apply(after(start, i / rate), ideal, 1 / rate, reading)) readings.push_back(reading);
  }
  return readings;
}

bool same(const auto& a, const auto& b) {
  return a.gyro == b.gyro && a.accel == b.accel && a.gyro_bias == b.gyro_bias && a.accel_bias == b.accel_bias;
}

// What a term can see.
struct Recorder {
  struct State {};
  std::vector<std::pair<bool, double>>* seen;
  void apply(ImuSensorSample<double>& sample, State&) const {
    seen->emplace_back(sample.first, sample.elapsed);
    CHECK(sample.truth.gyro == ideal.gyro);
    CHECK(sample.truth.accel == ideal.accel);
    CHECK(sample.bias.isZero(0));
  }
};

// A stamp's error of a user's own that has neither parameters nor state.
struct WholeSecondLate {
  struct State {};
  template <typename Scalar>
  void apply(Stamp<Scalar>& stamp, State&) const {
    stamp.offset += 1;
  }
};

const ErrorModel noise{WhiteNoise{0.1}, RandomWalk{0.2}};

}  // namespace

TEST_CASE("Without error terms a reading is the measurement") {
  for (const auto& r : readings_of(Imu{}, 3)) {
    CHECK(r.gyro == ideal.gyro);
    CHECK(r.accel == ideal.accel);
    CHECK(r.gyro_bias.isZero(0));
    CHECK(r.accel_bias.isZero(0));
  }
}

TEST_CASE("Each sensor has the errors of its model, and its bias is reported") {
  const auto r = readings_of(Imu{ErrorModel{ConstantBias{1}}, ErrorModel{ConstantBias{10}}}, 1)[0];
  CHECK(r.gyro == Eigen::Vector3d(2, 3, 4));
  CHECK(r.accel == Eigen::Vector3d(14, 15, 16));
  CHECK(r.gyro_bias == Eigen::Vector3d::Constant(1));
  CHECK(r.accel_bias == Eigen::Vector3d::Constant(10));
}

TEST_CASE("Terms know the first sample, the time since then and the true measurement of both sensors") {
  std::vector<std::pair<bool, double>> seen;
  const Imu imu{ErrorModel{Recorder{&seen}}, ErrorModel{}};
  auto errors = errors_of(imu);
  ImuReading r;
  double last = 0;
  for (const double time : {100.0, 100.5, 100.75, 104.0}) {
    CHECK(errors.apply(time, ideal, last == 0 ? 0.5 : time - last, r));
    CHECK(r.time == time);
    last = time;
  }
  CHECK(seen == std::vector<std::pair<bool, double>>{{true, 0}, {false, 0.5}, {false, 0.75}, {false, 4}});
}

TEST_CASE("At irregular times noise and walk have each interval's size") {
  const Imu imu{ErrorModel{WhiteNoise{0.1}}, ErrorModel{RandomWalk{0.1}}};
  auto irregular = errors_of(imu), regular = errors_of(imu);
  ImuReading r, s;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero(), unit_bias = Eigen::Vector3d::Zero();
  double time = 0;
  for (const double interval : {1.0, 0.25, 4.0, 0.01}) {
    time += interval;
    irregular.apply(time, ideal, interval, r);
    regular.apply(time, ideal, 1.0, s);
    CHECK(((r.gyro - ideal.gyro) * std::sqrt(interval) - (s.gyro - ideal.gyro)).norm() < 1e-14);
    CHECK(((r.accel_bias - bias) - (s.accel_bias - unit_bias) * std::sqrt(interval)).norm() < 1e-15);
    bias = r.accel_bias;
    unit_bias = s.accel_bias;
  }
}

TEST_CASE("The sensors' numbers are independent of each other and of the stamps'") {
  const auto r = readings_of(Imu{noise, noise}, 20);
  for (const auto& x : r) CHECK((x.gyro - ideal.gyro - (x.accel - ideal.accel)).cwiseAbs().minCoeff() > 1e-6);
  const ErrorModel stamps{StampJitter{1e-5}, DroppedSamples{0.0}};
  const auto gyro_only = readings_of(Imu{noise, ErrorModel{}}, 20),
             accel_only = readings_of(Imu{ErrorModel{}, noise}, 20);
  const auto stamped = readings_of(Imu{noise, noise, stamps}, 20);
  const auto seeded = readings_of(Imu{noise, noise}, 20, 200, 0.0, 2);
  for (std::size_t i = 0; i < r.size(); ++i) {
    CHECK(gyro_only[i].gyro == r[i].gyro);
    CHECK(accel_only[i].accel == r[i].accel);
    CHECK(same(stamped[i], r[i]));
    CHECK(seeded[i].gyro != r[i].gyro);
  }
}

TEST_CASE("Only an IMU whose stamps have errors tells true times") {
  using Plain = decltype(errors_of(Imu{noise, noise}))::Reading;
  using Stamped = decltype(errors_of(Imu{noise, noise, ErrorModel{ClockOffset{0.0}}}))::Reading;
  const auto has_true_time = []<typename R>(const R&) { return requires(R r) { r.true_time; }; };
  STATIC_CHECK(std::same_as<Plain, ImuReading>);
  CHECK_FALSE(has_true_time(Plain{}));
  CHECK(has_true_time(Stamped{}));
}

TEST_CASE("A stamp's error needs neither parameters nor state to count") {
  for (const auto& r : readings_of(Imu{ErrorModel{}, ErrorModel{}, ErrorModel{WholeSecondLate{}}}, 3))
    CHECK(r.time == r.true_time + 1);
}

TEST_CASE("Offset and drift of stamps that are epoch nanoseconds") {
  const nanoseconds epoch{1'403'715'524'907'143'168};
  const Imu imu{ErrorModel{}, ErrorModel{}, ErrorModel{ClockOffset{-0.003}, ClockDrift{2e-5}}};
  const auto readings = readings_of(imu, 2001, 200, epoch);
  CHECK(readings.front().true_time == epoch);
  CHECK(readings.front().time == epoch - nanoseconds{3'000'000});
  CHECK(readings.back().true_time == epoch + std::chrono::seconds{10});
  CHECK(readings.back().time - readings.back().true_time == nanoseconds{-3'000'000 + 200'000});
}

TEMPLATE_TEST_CASE("Stamps increase strictly, however much they jitter", "", double, nanoseconds) {
  const TestType epoch = after(TestType(0), 1.4e9);
  for (const double jitter : {1e-5, 0.005, 10.0}) {
    const Imu imu{noise, ErrorModel{}, ErrorModel{StampJitter{jitter}}};
    const auto readings = readings_of(imu, 5000, 200, epoch);
    CHECK(readings.size() == 5000);
    double squares = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (i > 0) REQUIRE(readings[i].time > readings[i - 1].time);
      REQUIRE(readings[i].true_time == after(epoch, static_cast<double>(i) / 200));
      squares += std::pow(to_seconds<double>(readings[i].time - readings[i].true_time), 2);
    }
    if (jitter == 1e-5) CHECK(std::abs(std::sqrt(squares / 5000) / jitter - 1) < 0.05);
  }
}

TEMPLATE_TEST_CASE("Stamps that jitter increase strictly in files, without a latency of their own", "", double,
                   nanoseconds) {
  constexpr int count = 20'000;
  for (const double start : {-7.3, 0.0, 1.4e9}) {
    for (const double rate : {50.0, 200.0, 8000.0}) {
      for (const double ratio : {0.05, 0.2, 0.5, 1.0, 3.0}) {
        CAPTURE(start, rate, ratio);
        const double deviation = ratio / rate;
        const Imu imu{ErrorModel{}, ErrorModel{},
                      ErrorModel{ClockOffset{0.25}, StampJitter{deviation}, ClockDrift{-1e-4}, DroppedSamples{0.1}}};
        const auto readings = readings_of(imu, count, rate, after(TestType(0), start));
        double sum = 0, squares = 0;
        for (std::size_t i = 0; i < readings.size(); ++i) {
          const auto& r = readings[i];
          if (i > 0) REQUIRE(to_nanoseconds(r.time) > to_nanoseconds(readings[i - 1].time));
          const double elapsed = to_seconds<double>(r.true_time - after(TestType(0), start));
          const double off = (to_seconds<double>(r.time - r.true_time) - 0.25 + 1e-4 * elapsed) / deviation;
          sum += off;
          squares += off * off;
        }
        const auto n = static_cast<double>(readings.size());
        const double independent = n / std::max(1.0, 2 * 16 * ratio * ratio);
        CHECK(std::abs(sum / n) < 4 / std::sqrt(independent));
        CHECK(std::abs(squares / n - 1) < 4 * std::sqrt(2 / independent));
      }
    }
  }
}

TEMPLATE_TEST_CASE("What no jitter is made for keeps the order, too", "", double, nanoseconds) {
  const Imu imu{ErrorModel{}, ErrorModel{}, ErrorModel{StampJitter{0.01}, StampJitter{0.01}, ClockDrift{-0.9}}};
  const auto readings = readings_of(imu, 5000, 200, TestType(0));
  for (std::size_t i = 1; i < readings.size(); ++i)
    REQUIRE(to_nanoseconds(readings[i].time) > to_nanoseconds(readings[i - 1].time));
}

TEST_CASE("A stamp beyond all numbers is refused") {
  auto errors = errors_of(Imu{ErrorModel{}, ErrorModel{}, ErrorModel{ClockOffset{1e308}, ClockOffset{1e308}}});
  decltype(errors)::Reading reading;
  CHECK_THROWS_WITH(errors.apply(0, ideal, 0.1, reading), "ImuErrors: stamp is inf, expected a finite number");
}

TEST_CASE("Samples that are dropped leave those that arrive as they were") {
  const Imu all{noise, noise, ErrorModel{StampJitter{1e-4}}};
  const Imu some{noise, noise, ErrorModel{StampJitter{1e-4}, DroppedSamples{0.3}}};
  const auto expected = readings_of(all, 1000), readings = readings_of(some, 1000);
  CHECK(readings.size() < 770);
  CHECK(readings.size() > 630);
  std::size_t i = 0;
  for (const auto& r : readings) {
    while (expected[i].true_time != r.true_time) ++i;
    REQUIRE(r.time == expected[i].time);
    REQUIRE(same(r, expected[i]));
  }
}

TEST_CASE("Of a sample that is dropped nothing is told") {
  const Imu imu{noise, noise, ErrorModel{DroppedSamples{0.5}}};
  auto errors = errors_of(imu);
  int dropped = 0;
  for (int i = 0; i < 100; ++i) {
    decltype(errors)::Reading reading{{{-1, {1, 1, 1}, {2, 2, 2}}, {3, 3, 3}, {4, 4, 4}}, -2};
    if (errors.apply(i, ideal, 1, reading)) {
      REQUIRE(reading.true_time == i);
      REQUIRE(reading.time == i);
      continue;
    }
    ++dropped;
    REQUIRE(reading.time == -1);
    REQUIRE(reading.true_time == -2);
    REQUIRE(reading.gyro == Eigen::Vector3d(1, 1, 1));
    REQUIRE(reading.accel == Eigen::Vector3d(2, 2, 2));
    REQUIRE(reading.gyro_bias == Eigen::Vector3d(3, 3, 3));
    REQUIRE(reading.accel_bias == Eigen::Vector3d(4, 4, 4));
  }
  CHECK(dropped > 30);
  CHECK(dropped < 70);
}

TEST_CASE("Elapsed time counts from the first sample taken, dropped or not") {
  const Imu imu{ErrorModel{RateRamp{1}}, ErrorModel{}, ErrorModel{DroppedSamples{0.9}, ClockDrift{0.5}}};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const auto& r : readings_of(imu, 10, 1, 100.0, seed)) {
      CHECK(r.gyro_bias == Eigen::Vector3d::Constant(r.true_time - 100));
      CHECK(r.time == r.true_time + (r.true_time - 100) / 2);
    }
  }
}

TEST_CASE("Another generator gives other numbers of the same kind") {
  const Imu imu{ErrorModel{WhiteNoise{0.1}}, ErrorModel{TurnOnBias{0.1}}};
  const auto ours = readings_of(imu, 4000), theirs = readings_of<double, std::mt19937_64>(imu, 4000);
  double squares = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    REQUIRE(ours[i].gyro != theirs[i].gyro);
    squares += (theirs[i].gyro - ideal.gyro).squaredNorm() / 3;
  }
  CHECK(ours[0].accel != theirs[0].accel);
  const double expected = 0.1 * std::sqrt(200.0);
  CHECK(std::abs(std::sqrt(squares / 4000) / expected - 1) < 4 / std::sqrt(2.0 * 3 * 4000));
}

TEST_CASE("A run can be copied and goes on the same way in both") {
  const Imu imu{noise, noise, ErrorModel{StampJitter{1e-4}}};
  auto errors = errors_of(imu);
  decltype(errors)::Reading a, b;
  errors.apply(0, ideal, 0.1, a);
  auto copy = errors;
  errors.apply(0.1, ideal, 0.1, a);
  copy.apply(0.1, ideal, 0.1, b);
  CHECK(same(a, b));
  CHECK(a.time == b.time);
}
