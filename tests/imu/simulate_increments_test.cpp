// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/clock/clock_offset.hpp>
#include <splinertia/errors/clock/dropped_samples.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/simulate_increments.hpp>
#include <splinertia/imu/to_vector.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrate.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <stdexcept>
#include <vector>

#include "strapdown/aggressive_motion.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// ∫ω dt and ∫f dt by the midpoint rule on n parts, which needs neither nodes nor weights; error about h²f''/24n².
ImuIncrement<> integral(const auto& motion, double from, double to, int n, const auto&... mounting) {
  ImuIncrement<> sum{to, {0, 0, 0}, {0, 0, 0}};
  const double h = (to - from) / n;
  for (int i = 0; i < n; ++i) {
    const auto m =
        ideal_imu(motion.template evaluate<2>(from + (i + 0.5) * h), standard_gravity<double>(), mounting...);
    sum.delta_angle += m.gyro * h;
    sum.delta_velocity += m.accel * h;
  }
  return sum;
}

double distance(const ImuIncrement<>& a, const ImuIncrement<>& b) {
  return (a.delta_angle - b.delta_angle).norm() + (a.delta_velocity - b.delta_velocity).norm();
}

}  // namespace

TEST_CASE("Increments are the integrals of what a perfect IMU reads") {
  const testing::AggressiveMotion<> motion;
  std::size_t i = 0;
  for (const auto& r : simulate_increments(motion, Imu{}, {.rate = 200, .start = 1.0, .end = 1.1})) {
    const double begin = 1 + static_cast<double>(i++) / 200;
    CHECK(r.time == 1 + static_cast<double>(i) / 200);
    CHECK(r.true_time == r.time);
    CHECK(r.gyro_bias.isZero(0));
    CHECK(distance(r, integral(motion, begin, r.time, 2000)) < 1e-9);
  }
  CHECK(i == 20);
}

TEST_CASE("Integrals over long intervals are the sums of those over short ones") {
  const Ellipse<> motion;  // fastest at 10 K = 3.14 rad/s
  const auto whole = to_vector(simulate_increments(motion, Imu{}, {.rate = 10, .start = 0.0, .end = 2.0}));
  const auto parts = to_vector(simulate_increments(motion, Imu{}, {.rate = 100, .start = 0.0, .end = 2.0}));
  REQUIRE(whole.size() == 20);
  REQUIRE(parts.size() == 200);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    ImuIncrement<> sum{0, {0, 0, 0}, {0, 0, 0}};
    for (std::size_t j = 10 * i; j < 10 * i + 10; ++j) {
      sum.delta_angle += parts[j].delta_angle;
      sum.delta_velocity += parts[j].delta_velocity;
    }
    CHECK(distance(whole[i], sum) < 1e-13);
  }
}

namespace {
/// A curve that does not tell where its knots are.
template <typename Curve>
struct WithoutKnots {
  using Group = typename Curve::Group;
  using Time = typename Curve::Time;
  const Curve& curve;
  [[nodiscard]] Time start() const { return curve.start(); }
  [[nodiscard]] Time end() const { return curve.end(); }
  template <int D>
  [[nodiscard]] Motion<Group, D> evaluate(Time t) const {
    return curve.template evaluate<D>(t);
  }
};
}  // namespace

// A cubic's acceleration has kinks at the knots: quadrature across them is wrong by 1e-5 here.
TEMPLATE_TEST_CASE("A spline is integrated from knot to knot", "", UniformKnots<double>, NonUniformKnots<double>) {
  testing::Random random(4);
  const auto points = random.walk<SO3xR3<double>>(14, 0.05);
  const auto curve = [&] {
    if constexpr (std::is_same_v<TestType, UniformKnots<double>>) {
      return Spline<SO3xR3<double>, 4>({.start = 0, .interval = 0.1}, points);
    } else {
      std::vector<double> knots;
      for (int i = -3; i <= 14; ++i) knots.push_back(0.1 * i + 0.02 * std::sin(5.0 * i));
      return Spline<SO3xR3<double>, 4, NonUniformKnots<double>>({knots}, points);
    }
  }();
  const double start = curve.start() + 0.013;
  double worst = 0, across = 0;
  const SimulationOptions<> options{.rate = 7, .start = start, .end = start + 1};
  const WithoutKnots<std::remove_cvref_t<decltype(curve)>> smooth{curve};
  const auto unsplit = to_vector(simulate_increments(smooth, Imu{}, options));
  std::size_t i = 0;
  for (const auto& r : simulate_increments(curve, Imu{}, options)) {
    const auto truth = integral(curve, r.time - 1.0 / 7, r.time, 40000);
    worst = std::max(worst, distance(r, truth));
    across = std::max(across, distance(unsplit[i++], truth));
  }
  CHECK(worst < 2e-9);  // which is the error of `truth`, at the kinks
  CHECK(across > 1e-5);
}

TEST_CASE("Noise of density N is N √h in an increment, a bias b is b h") {
  const double h = 0.02;
  const Imu imu{ErrorModel{ConstantBias{0.1}, WhiteNoise{0.01}}, ErrorModel{WhiteNoise{0.2}}};
  double gyro = 0, accel = 0, count = 0;
  for (const auto& r :
       simulate_increments(at_rest(SO3xR3<double>{}), imu, {.rate = 1 / h, .seed = 3, .start = 0.0, .end = 200.0})) {
    CHECK((r.gyro_bias - Eigen::Vector3d::Constant(0.1)).norm() < 1e-15);
    gyro += (r.delta_angle - r.gyro_bias * h).squaredNorm();
    accel += (r.delta_velocity - Eigen::Vector3d(0, 0, 9.80665 * h)).squaredNorm();
    count += 3;
  }
  const double spread = 4 / std::sqrt(2 * count);  // four standard deviations
  CHECK(std::abs(std::sqrt(gyro / count) / (0.01 * std::sqrt(h)) - 1) < spread);
  CHECK(std::abs(std::sqrt(accel / count) / (0.2 * std::sqrt(h)) - 1) < spread);
}

TEST_CASE("The mean errors are those of a sample at the end of the interval") {
  const Imu imu{ErrorModel{WhiteNoise{0.01}}, ErrorModel{WhiteNoise{0.2}}};
  const auto body = at_rest(SO3xR3<double>{});
  const auto increments = to_vector(simulate_increments(body, imu, {.rate = 50, .seed = 3, .start = 0.0, .end = 1.0}));
  const auto samples = to_vector(simulate(body, imu, {.rate = 50, .seed = 3, .start = 0.02, .end = 1.0}));
  REQUIRE(increments.size() == samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(increments[i].time == Approx(samples[i].time));
    CHECK((increments[i].delta_angle / 0.02 - samples[i].gyro).norm() < 1e-14);
    CHECK((increments[i].delta_velocity / 0.02 - samples[i].accel).norm() < 1e-13);
  }
}

TEST_CASE("Increments integrate back, with errors that fall with the fourth power of the interval") {
  const Ellipse<> motion;
  const auto error = [&](double rate) {
    const auto end =
        integrate<TwoSampleIncrements>(nav_state(motion.evaluate<1>(0.0), 0.0),
                                       simulate_increments(motion, Imu{}, {.rate = rate, .start = 0.0, .end = 10.0}))
            .back();
    CHECK(end.time == 10);
    return (end.p_WB - position(motion.evaluate<0>(10.0).value)).norm();
  };
  const double coarse = error(50), fine = error(100);
  CHECK(coarse < 5e-7);  // 3.6e-7 m
  CHECK(coarse / fine > 14);
}

TEST_CASE("Mounted, increments integrate back to the path of the IMU") {
  const Ellipse<> motion;
  const Mounting mounting{Sophus::SO3d::exp({0.4, -0.8, 1.1}), Eigen::Vector3d(0.3, -0.5, 0.2)};
  const auto increments = simulate_increments(motion, Imu{}, mounting, {.rate = 200, .start = 0.0, .end = 5.0});
  CHECK(distance(*increments.begin(), integral(motion, 0, 0.005, 2000, mounting)) < 1e-10);
  const auto begin = nav_state(motion.evaluate<1>(0.0), 0.0, mounting),
             end = nav_state(motion.evaluate<1>(5.0), 5.0, mounting);
  const auto reckoned = integrate<TwoSampleIncrements>(begin, increments).back();
  CHECK((reckoned.p_WB - end.p_WB).norm() < 1e-8);
  CHECK((reckoned.v_WB - end.v_WB).norm() < 1e-8);
  CHECK(increment(reckoned.R_WB, end.R_WB).norm() < 1e-9);

  const auto motion_between = preintegrate<TwoSampleIncrements>(0.0, increments);
  CHECK(increment(begin.R_WB * Sophus::SO3d(motion_between.delta().rotation), end.R_WB).norm() < 1e-9);
}

TEST_CASE("In nanoseconds since an epoch nothing is lost") {
  const nanoseconds epoch{1'400'000'000'000'000'000};
  testing::Random random(5);
  const auto points = random.walk<SO3xR3<double>>(14);
  const Spline<SO3xR3<double>, 4> seconds({.start = 0, .interval = 0.1}, points);
  const Spline<SO3xR3<double>, 4, UniformKnots<nanoseconds>> ticks(
      {.start = epoch, .interval = nanoseconds(100'000'000)}, points);
  const auto expected = to_vector(simulate_increments(seconds, Imu{}, {.rate = 300}));
  std::size_t i = 0;
  for (const auto& r : simulate_increments(ticks, Imu{}, {.rate = 300})) {
    // Ticks round a time by up to half a nanosecond.
    CHECK(std::abs(to_seconds<double>(r.time - epoch) - expected[i].time) < 0.51e-9);
    // The ends of an interval are rounded to 1 ns, at up to 300 rad/s and m/s².
    CHECK((r.delta_angle - expected[i].delta_angle).norm() < 3e-7);
    CHECK((r.delta_velocity - expected[i].delta_velocity).norm() < 3e-7);
    ++i;
  }
  CHECK(i == expected.size());
}

TEST_CASE("A dropped increment is lost, and the stamps have their errors") {
  const auto body = at_rest(SO3xR3<double>{});
  const Imu imu{ErrorModel{}, ErrorModel{}, ErrorModel{ClockOffset{0.25}, DroppedSamples{0.5}}};
  const auto run = simulate_increments(body, imu, {.rate = 10, .seed = 1, .start = 0.0, .end = 100.0});
  const auto kept = to_vector(run);
  CHECK(run.size() == 1000);
  CHECK(kept.size() > 400);
  CHECK(kept.size() < 600);
  for (const auto& r : kept) {
    CHECK(r.time - r.true_time == Approx(0.25));
    // Of one interval. Its ends are times near 100 s, each rounded by up to 0.7e-14 s, times 9.8 m/s^2.
    CHECK((r.delta_velocity - Eigen::Vector3d(0, 0, 0.980665)).norm() < 1e-12);
  }
}

TEST_CASE("A time alone has no increment, and bad options are named") {
  const Ellipse<> motion;
  const auto none = simulate_increments(motion, Imu{}, {.start = 1.0, .end = 1.0});
  CHECK(none.size() == 0);
  CHECK(none.begin() == none.end());
  CHECK(testing::message_of([&] {
          return simulate_increments(motion, Imu{}, {.rate = -1, .start = 0.0, .end = 1.0}).size();
        }) == "simulate_increments: rate is -1 Hz, expected a positive finite number");
  CHECK(testing::message_of([&] { return simulate_increments(motion, Imu{}).size(); }).find("simulate_increments: ") ==
        0);
}
