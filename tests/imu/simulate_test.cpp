// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <ranges>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/bias/rate_ramp.hpp>
#include <splinertia/errors/bias/temperature_bias.hpp>
#include <splinertia/errors/bias/turn_on_bias.hpp>
#include <splinertia/errors/clock/clock_drift.hpp>
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/clock/stamp_jitter.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/output/first_order_bandwidth.hpp>
#include <splinertia/errors/output/second_order_bandwidth.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/errors/scale/scale_factor.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/spline.hpp>
#include <stdexcept>
#include <string>
#include <utility>
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

TEST_CASE("The bias reported is the one in the sample, through all that acts on both") {
  const Eigen::Matrix3d M = (Eigen::Matrix3d() << 1, 0.1, 0, 0, 0.9, -0.1, 0.2, 0, 1.1).finished();
  const auto model = [&](double size) {
    return ErrorModel{ConstantBias{size}, TurnOnBias{size},        RandomWalk{size}, Misalignment{M},
                      RateRamp{size},     FirstOrderBandwidth{10}, ScaleFactor{0.1}, SecondOrderBandwidth{20, 0.7}};
  };
  const Ellipse<> motion;
  const auto with_bias = simulate(motion, Imu{model(0.1), model(0.2)}, {.seed = 3, .start = 0.0, .end = 2.0});
  const auto without = simulate(motion, Imu{model(0), model(0)}, {.seed = 3, .start = 0.0, .end = 2.0});
  auto clean = without.begin();
  for (const auto& r : with_bias) {
    REQUIRE((r.gyro - r.gyro_bias - clean->gyro).norm() < 1e-12);
    REQUIRE((r.accel - r.accel_bias - clean->accel).norm() < 1e-12);
    REQUIRE(r.gyro_bias.norm() > 0);
    ++clean;
  }
}

TEST_CASE("Several IMUs of a run have errors of their own, each the same whatever else there is") {
  const Ellipse<> motion;
  const auto samples = [&](const auto& imu, std::uint64_t which) {
    std::vector<Eigen::Vector3d> gyros, accels;
    for (const auto& r : simulate(motion, imu, {.seed = 1, .imu = which, .start = 0.0, .end = 0.5})) {
      gyros.push_back(r.gyro);
      accels.push_back(r.accel);
    }
    return std::pair(gyros, accels);
  };
  const auto first = samples(noisy, 0), second = samples(noisy, 1);
  for (std::size_t i = 0; i < first.first.size(); ++i) {
    CHECK(first.first[i] != second.first[i]);
    CHECK(first.second[i] != second.second[i]);
  }
  const ErrorModel stamps{StampJitter{1e-4}, DroppedSamples{0.0}};
  CHECK(samples(Imu{noisy.gyro, ErrorModel{ConstantBias{1}, WhiteNoise{1.0}}, stamps}, 0).first == first.first);
  CHECK(samples(Imu{ErrorModel{}, noisy.accel, stamps}, 1).second == second.second);
  // The name of its random numbers.
  auto state = noisy.gyro.start(StreamKey(1) / 1 / "gyro");
  const auto ideal_first = ideal_imu(motion.evaluate<2>(0.0));
  SensorSample<double> sample{ideal_first.gyro, Eigen::Vector3d::Zero(), 1 / 200.0, true, 0};
  noisy.gyro.apply(sample, state);
  CHECK(sample.value == second.first[0]);
}

TEST_CASE("Random numbers come from any generator asked for") {
  const auto gyros = [&](const auto& run) {
    std::vector<Eigen::Vector3d> values;
    for (const auto& r : run) values.push_back(r.gyro);
    return values;
  };
  const Ellipse<> motion;
  const auto ours = gyros(simulate(motion, noisy, {.seed = 1, .start = 0.0, .end = 1.0}));
  const auto theirs = gyros(simulate<std::mt19937_64>(motion, noisy, {.seed = 1, .start = 0.0, .end = 1.0}));
  const auto small = gyros(simulate<std::minstd_rand>(motion, noisy, {.seed = 1, .start = 0.0, .end = 1.0}));
  CHECK(theirs == gyros(simulate<std::mt19937_64>(motion, noisy, {.seed = 1, .start = 0.0, .end = 1.0})));
  for (std::size_t i = 0; i < ours.size(); ++i) {
    CHECK(ours[i] != theirs[i]);
    CHECK(ours[i] != small[i]);
    CHECK((theirs[i] - ours[i]).norm() < 10 * 0.2121);
  }
}

TEST_CASE("Samples that are dropped leave those that arrive as they were") {
  const Ellipse<> motion;
  const auto arriving = [&](double probability, std::uint64_t seed) {
    const Imu imu{noisy.gyro, noisy.accel, ErrorModel{DroppedSamples{probability}}};
    return simulate(motion, imu, {.rate = 100, .seed = seed, .start = 0.0, .end = 10.0});
  };
  std::vector<Eigen::Vector3d> all;
  for (const auto& r : arriving(0, 1)) all.push_back(r.gyro);
  CHECK(all.size() == 1001);
  std::size_t count = 0;
  for (const auto& r : arriving(0.5, 1)) {
    CHECK(r.time == r.true_time);
    CHECK(r.gyro == all[static_cast<std::size_t>(std::lround(r.time * 100))]);
    ++count;
  }
  CHECK(count > 1001 / 2 - 64);  // four standard deviations
  CHECK(count < 1001 / 2 + 64);
  CHECK(arriving(0.5, 1).size() == 1001);
}

TEST_CASE("A run ends well where its last samples are dropped, or its first, or all") {
  const auto rest = at_rest(SO3xR3<double>{});
  const Imu imu{noisy.gyro, noisy.accel, ErrorModel{DroppedSamples{0.7}}};
  int none = 0, first_lost = 0, last_lost = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto run = simulate(rest, imu, {.rate = 1, .seed = seed, .start = 0.0, .end = 3.0});
    std::vector<double> times;
    for (const auto& r : run) times.push_back(r.true_time);
    CHECK((run.begin() == run.end()) == times.empty());
    CHECK(std::is_sorted(times.begin(), times.end()));
    none += times.empty();
    first_lost += !times.empty() && times.front() > 0;
    last_lost += !times.empty() && times.back() < 3;
  }
  CHECK(none > 20);  // 0.7⁴ is a quarter
  CHECK(first_lost > 20);
  CHECK(last_lost > 20);
}

TEST_CASE("A clock that is off tells the true time, too") {
  testing::Random random(1);
  const Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>> curve(
      {nanoseconds{1'403'715'524'907'143'168}, nanoseconds{100'000'000}}, random.walk<SO3xR3<double>>(13));
  const Imu imu{ErrorModel{}, ErrorModel{}, ErrorModel{ClockOffset{0.005}, ClockDrift{1e-3}, StampJitter{0.01}}};
  std::vector<nanoseconds> times, true_times;
  for (const auto& r : simulate(curve, imu, {.rate = 200, .seed = 4})) {
    times.push_back(r.time);
    true_times.push_back(r.true_time);
    CHECK(r.accel == ideal_imu(curve.evaluate<2>(r.true_time)).accel);  // taken on time
  }
  CHECK(times.size() == 201);
  CHECK(true_times.front() == curve.start());
  CHECK(true_times.back() == curve.end());
  CHECK(std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end());
}

TEST_CASE("A run is a range for the standard library, whatever the terms are") {
  const Ellipse<> motion;
  const Imu imu{noisy.gyro, ErrorModel{TemperatureBias{0.1, WarmUp{20, 60, 300}}}, ErrorModel{StampJitter{1e-4}}};
  auto run = simulate(motion, imu, {.rate = 10, .start = 0.0, .end = 1.0});
  STATIC_CHECK(std::ranges::input_range<decltype(run)>);
  STATIC_CHECK(std::ranges::input_range<decltype(simulate<std::mt19937_64>(motion, imu))>);
  int count = 0;
  for ([[maybe_unused]] const auto& reading : run) ++count;
  CHECK(count == 11);
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
  CHECK_THROWS_WITH(simulate(motion, ideal, {.rate = 0, .start = 0.0, .end = 1.0}),
                    "simulate: rate is 0 Hz, expected a positive finite number");
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = INFINITY, .start = 0.0, .end = 1.0}), std::invalid_argument);
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = std::nan(""), .start = 0.0, .end = 1.0}), std::invalid_argument);
  CHECK_THROWS_WITH(simulate(motion, ideal, {.rate = 10}),
                    "simulate: the motion has no bounds, expected options .start and .end");
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = 10, .start = 1.0, .end = 0.0}), std::invalid_argument);
  testing::Random random(1);
  const Spline<SO3xR3<double>, 4> curve({.start = 0, .interval = 1}, random.walk<SO3xR3<double>>(6));
  CHECK_THROWS_WITH(simulate(curve, ideal, {.rate = 10, .start = -1.0}),
                    "simulate: samples wanted from -1 to 3, the motion is defined from 0 to 3");
}

namespace {

/// A body at rest, whose acceleration is a number of its own from 1 s on.
struct Broken {
  using Group = SO3xR3<double>;
  using Time = double;
  double acceleration;
  int axis;  // of R³, then of so(3)

  [[nodiscard]] double start() const { return 0; }
  [[nodiscard]] double end() const { return 2; }
  template <int D>
  [[nodiscard]] splinertia::Motion<Group, D> evaluate(double t) const {
    auto motion = at_rest(Group{}).template evaluate<D>(t);
    if (t >= 1) (axis < 3 ? motion.acceleration[3 + axis] : motion.velocity[axis - 3]) = acceleration;
    return motion;
  }
};

constexpr double inf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("A motion that gives what is not finite is refused at the sample that it is in") {
  for (const int axis : {0, 1, 2, 3, 4, 5}) {
    for (const double value : {inf, -inf, std::nan("")}) {
      const Broken motion{value, axis};
      int arrived = 0;
      const auto go = [&] {
        for (const auto& r : simulate(motion, noisy, {.rate = 50})) arrived += r.time < 1;
      };
      const std::string which = axis < 3 ? "accel " : "gyro ";
      CHECK_THROWS_WITH(go(), Catch::Matchers::StartsWith("simulate: the motion gives " + which) &&
                                  Catch::Matchers::EndsWith(" at sample 50, time 1, expected a finite number"));
      CHECK(arrived == 50);
    }
  }
  CHECK_THROWS_WITH(
      [] {
        for (const auto& r : simulate(Broken{inf, 4}, ideal, {.rate = 50})) CHECK(r.gyro.allFinite());
      }(),
      "simulate: the motion gives gyro y = inf at sample 50, time 1, expected a finite number");
}

TEST_CASE("A spline whose readings overflow is refused") {
  std::vector<SO3xR3<double>> points;
  for (int i = 0; i < 20; ++i) points.push_back({{}, {0, i % 2 == 0 ? 1e307 : -1e307, 0}});
  const Spline<SO3xR3<double>, 4> curve({.start = 0, .interval = 0.01}, points);
  CHECK_THROWS_WITH(simulate(curve, ideal, {.rate = 1000}).begin(),
                    Catch::Matchers::StartsWith("simulate: the motion gives accel ") &&
                        Catch::Matchers::EndsWith(" at sample 0, time 0, expected a finite number"));
}

TEST_CASE("Readings of any finite size pass") {
  for (const auto& r : simulate(Broken{1e300, 1}, ideal, {.rate = 50})) REQUIRE(r.accel.allFinite());
}

TEST_CASE("Options that are not finite are refused by name") {
  const Ellipse<> motion;
  const double nan = std::nan("");
  CHECK_THROWS_WITH(simulate(motion, ideal, {.gravity = {0, nan, 0}, .start = 0.0, .end = 1.0}),
                    "simulate: gravity is nan, expected a finite number");
  CHECK_THROWS_WITH(simulate(motion, ideal, {.gravity = {0, 0, -inf}, .start = 0.0, .end = 1.0}),
                    "simulate: gravity is -inf, expected a finite number");
  CHECK_THROWS_WITH(simulate(motion, ideal, {.start = nan, .end = 1.0}),
                    "simulate: start is nan, expected a finite number");
  CHECK_THROWS_WITH(simulate(motion, ideal, {.start = 0.0, .end = nan}),
                    "simulate: end is nan, expected a finite number");
  CHECK_THROWS_WITH(simulate(motion, ideal, {.start = inf, .end = inf}),
                    "simulate: start is inf, expected a finite number");
  CHECK_THROWS_WITH(simulate(motion, ideal, {.rate = 1e-320, .start = 0.0, .end = 1.0}),
                    "simulate: rate is 9.99989e-321 Hz, expected a finite, non-zero interval 1/rate");
}

TEST_CASE("More samples than can be counted are refused") {
  const Ellipse<> motion;
  CHECK_THROWS_WITH(simulate(motion, ideal, {.rate = 1e18, .start = 0.0, .end = 100.0}),
                    "simulate: 1e+18 Hz for 100 s makes 1e+20 samples, expected fewer than 9007199254740992");
  CHECK_THROWS_WITH(simulate(motion, ideal, {.rate = 1, .start = 0.0, .end = 1e300}),
                    "simulate: 1 Hz for 1e+300 s makes 1e+300 samples, expected fewer than 9007199254740992");
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = 1e300, .start = 0.0, .end = 1e300}), std::invalid_argument);
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = 1, .start = -1.7e308, .end = 1.7e308}), std::invalid_argument);
  CHECK(simulate(motion, ideal, {.rate = 1e-300, .start = 0.0, .end = 1e3}).size() == 1);
  CHECK(simulate(motion, ideal, {.rate = 1e6, .start = 0.0, .end = 1e9}).size() == 1'000'000'000'000'001);
}

TEST_CASE("A rate beyond the clock's resolution is refused") {
  testing::Random random(1);
  const Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>> curve({nanoseconds{0}, nanoseconds{10}},
                                                                   random.walk<SO3xR3<double>>(5));
  CHECK_THROWS_WITH(simulate(curve, ideal, {.rate = 3e9}),
                    "simulate: rate is 3e+09 Hz, expected samples at least 1e-09 s apart, so that their times differ");
  const auto strictly_increasing = [](const auto& run) {
    for (std::size_t i = 1; i < run.size(); ++i) REQUIRE(run.time(i) > run.time(i - 1));
  };
  for (const double rate : {1e9, 7e8, 3e8}) strictly_increasing(simulate(curve, ideal, {.rate = rate}));

  const Ellipse<> motion;
  const double epoch = 1.4e9;
  CHECK_THROWS_AS(simulate(motion, ideal, {.rate = 5e6, .start = epoch, .end = epoch + 1}), std::invalid_argument);
  strictly_increasing(simulate(motion, ideal, {.rate = 8e5, .start = epoch, .end = epoch + 0.01}));
  CHECK(simulate(motion, ideal, {.rate = 5e6, .start = epoch, .end = epoch}).size() == 1);
}
