// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <splinertia/group/pose.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/fit/knot_choice.hpp>
#include <string>
#include <vector>

#include "strapdown/aggressive_motion.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;
using Numbers = std::vector<Stamped<Number, double>>;
using G = SO3xR3<double>;
using Poses = std::vector<Stamped<G, double>>;
using Curve = Spline<G, 4>;
using std::numbers::pi;

Numbers numbers(double rate, int count, const auto& f, double noise = 0, std::uint64_t seed = 1) {
  NormalStream normal{StreamKey(seed)};
  Numbers result;
  for (int i = 0; i < count; ++i) result.push_back({i / rate, Number(f(i / rate) + noise * normal())});
  return result;
}

std::optional<MotionAtScale<Number>> scale(const Numbers& poses, double h) {
  return motion_at_scale(UnbrokenPoses<Number, double>(poses), h);
}

/// An attitude and a position, as a motion; the derivatives by differences.
struct Path {
  std::function<Eigen::Vector3d(double)> turn, position;

  [[nodiscard]] Sophus::SO3d attitude(double t) const { return Sophus::SO3d::exp(turn(t)); }
  [[nodiscard]] Eigen::Vector3d omega(double t) const {
    const double h = 1e-4;
    return (attitude(t - h).inverse() * attitude(t + h)).log() / (2 * h);
  }
};

Poses poses_of(const Path& path, double rate, double length, double rotation_noise, double position_noise) {
  NormalStream normal{StreamKey(4)};
  Poses poses;
  for (int i = 0; i <= std::lround(rate * length); ++i) {
    const double t = i / rate;
    Eigen::Vector3d turn, shift;
    for (double& x : turn) x = rotation_noise * normal();
    for (double& x : shift) x = position_noise * normal();
    poses.push_back({t, {path.attitude(t) * Sophus::SO3d::exp(turn), Eigen::Vector3d(path.position(t) + shift)}});
  }
  return poses;
}

/// The RMS of what a gyro on the curve reads beside the truth, rad/s.
double gyro_error(const Curve& curve, const Path& path) {
  double squares = 0;
  int count = 0;
  for (double t = curve.start() + 1e-3; t < curve.end() - 1e-3; t += 2.3e-3, ++count) {
    squares += (angular_velocity(curve.evaluate<1>(t)) - path.omega(t)).squaredNorm();
  }
  return std::sqrt(squares / count);
}

double bump(double t, double at, double width) { return std::exp(-std::pow((t - at) / width, 2)); }

}  // namespace

TEST_CASE("At a scale, the residual and the acceleration of a sine are as theory has them") {
  // 50 periods of sin ωt. The cubic through ±h and ±2h misses by (1 − 4/3 cos ωh + 1/3 cos 2ωh) of it, the parabola has
  // 2 (1 − cos ωh)/h² of it; the mean square of a sine is 1/2.
  const double omega = 2 * pi;
  const auto poses = numbers(1000, 50001, [&](double t) { return std::sin(omega * t); });
  for (const double h : {0.05, 0.1, 0.2}) {
    const auto found = scale(poses, h);
    REQUIRE(found);
    const double residual = 1 - 4. / 3 * std::cos(omega * h) + std::cos(2 * omega * h) / 3;
    const double acceleration = 2 * (1 - std::cos(omega * h)) / (h * h);
    CHECK_THAT(found->residual_square[0], WithinRel(residual * residual / 2, 5e-3));
    CHECK_THAT(found->acceleration_square[0], WithinRel(acceleration * acceleration / 2, 5e-3));
  }
}

TEST_CASE("At a scale of white noise, the residual is 35/18 of its square") {
  const auto poses = numbers(100, 4000, [](double) { return 0; }, 0.01);
  const auto found = scale(poses, 0.04);
  REQUIRE(found);
  // The mean of 4000 squares scatters by √(2/4000), and somewhat more for neighbours that share poses.
  CHECK_THAT(found->residual_square[0], WithinRel(35. / 18 * 1e-4, 0.12));
}

TEST_CASE("A scale needs poses there") {
  const auto poses = numbers(10, 7, [](double t) { return t; });
  CHECK(scale(poses, 0.1));
  CHECK_FALSE(scale(poses, 0.2));   // two of the middle ones are too few
  CHECK_FALSE(scale(poses, 0.05));  // between the poses
}

TEST_CASE("The longest interval without ambiguity") {
  const auto turning = [](double degrees) {
    std::vector<Stamped<Sophus::SO3d, double>> poses;
    for (int i = 0; i < 20; ++i) poses.push_back({1. * i, Sophus::SO3d::rotZ(degrees * pi / 180 * i)});
    return poses;
  };
  CHECK_THAT(longest_unambiguous_interval(turning(95)), WithinRel(120. / 95, 1e-9));
  CHECK_THAT(longest_unambiguous_interval(turning(170)), WithinRel(120. / 170, 1e-9));
  CHECK(std::isinf(longest_unambiguous_interval(turning(0))));
  CHECK(std::isinf(longest_unambiguous_interval(numbers(1, 20, [](double t) { return t; }))));
  // One jump of attitude does not count, two fast steps in a row do.
  auto jump = turning(10);
  for (std::size_t i = 10; i < 20; ++i) jump[i].value *= Sophus::SO3d::rotX(2.);
  CHECK_THAT(longest_unambiguous_interval(jump), WithinRel(12., 1e-6));
  auto fast = turning(10);
  fast.resize(12);
  fast[11].value = fast[9].value * Sophus::SO3d::rotZ(200 * pi / 180);
  fast[10].value = fast[9].value * Sophus::SO3d::rotZ(100 * pi / 180);
  CHECK_THAT(longest_unambiguous_interval(fast), WithinRel(1.2, 1e-6));
  auto two = turning(60);
  two.resize(2);
  CHECK_THAT(longest_unambiguous_interval(two), WithinRel(2., 1e-9));
}

TEST_CASE("Each limit is named") {
  const auto still = choose_knot_interval(numbers(100, 2000, [](double) { return 1; }, 1e-3));
  CHECK(still.limit == KnotLimit::length);
  CHECK_THAT(still.interval, WithinRel(0.64, 0.2));
  CHECK_THAT(still.pose_interval, WithinRel(0.01, 1e-9));
  CHECK_THAT(still.noise[0], WithinRel(1e-3, 0.15));
  // Few poses of it: eight segments.
  CHECK_THAT(choose_knot_interval(numbers(100, 81, [](double) { return 1; }, 1e-3)).interval, WithinRel(0.1, 1e-9));

  const auto wave = [](double t) { return std::sin(10 * t); };
  const auto moving = choose_knot_interval(numbers(100, 2000, wave, 1e-3));
  CHECK(moving.limit == KnotLimit::motion);
  const auto noisier = choose_knot_interval(numbers(100, 2000, wave, 1e-1));
  CHECK(noisier.limit == KnotLimit::motion);
  CHECK(noisier.interval > 1.5 * moving.interval);

  const auto sparse = choose_knot_interval(numbers(2, 200, [](double t) { return std::sin(2 * t); }));
  CHECK(sparse.limit == KnotLimit::poses);
  CHECK_THAT(sparse.interval, WithinRel(1.25 * 0.5, 1e-9));

  std::vector<Stamped<Sophus::SO3d, double>> turning;
  for (int i = 0; i < 100; ++i) turning.push_back({1. * i, Sophus::SO3d::rotZ(2 * pi / 3 * i)});
  const auto turn = choose_knot_interval(turning);
  CHECK(turn.limit == KnotLimit::turn);
  CHECK_THAT(turn.interval, WithinRel(1.0, 1e-9));
}

TEST_CASE("A lower order takes knots nearer together") {
  const auto poses = numbers(200, 4000, [](double t) { return std::sin(4 * t); }, 1e-3);
  double before = 0;
  for (const int order : {2, 3, 4}) {
    const double interval = choose_knot_interval(poses, order).interval;
    CHECK(interval > 1.3 * before);
    before = interval;
  }
  CHECK(choose_knot_interval(poses, 6).interval == before);
}

TEST_CASE("Few poses, poses at one place, and single precision") {
  const auto line = [](double t) { return t; };
  for (const int count : {2, 3, 4, 5, 8}) {
    for (const double slope : {0., 1.}) {
      const auto choice = choose_knot_interval(numbers(10, count, [&](double t) { return slope * line(t); }));
      CHECK(choice.interval >= 0.125 - 1e-12);
      CHECK(choice.interval <= 0.2);
    }
  }
  std::vector<Stamped<Sophus::SE3f, nanoseconds>> poses;
  const nanoseconds epoch{1'403'715'524'907'143'168};
  for (int i = 0; i < 300; ++i) poses.push_back({epoch + i * nanoseconds(5'000'000), Sophus::SE3f()});
  CHECK_THAT(choose_knot_interval(poses).interval, WithinRel(299 * 0.005 / 8, 0.2));
}

TEST_CASE("Holes and gross outliers hardly change the choice") {
  const auto wave = [](double t) { return std::sin(5 * t); };
  const auto clean = numbers(100, 3000, wave, 1e-3);
  const double expected = choose_knot_interval(clean).interval;
  auto poses = clean;
  std::erase_if(poses, [](const auto& p) { return (p.time > 3 && p.time < 4) || (p.time > 11 && p.time < 11.4); });
  CHECK_THAT(choose_knot_interval(poses).interval, WithinRel(expected, 0.2));
  for (const std::size_t i : {400U, 401U, 1700U}) poses[i].value[0] += 50;
  CHECK_THAT(choose_knot_interval(poses).interval, WithinRel(expected, 0.2));
}

TEST_CASE("With chosen knots the gyro is within 1.3 times the error of the best fixed interval") {
  const auto sines = [](double a, double b, double c, double rate) {
    return [=](double t) {
      return Eigen::Vector3d(a * std::sin(rate * t), b * std::sin(1.3 * rate * t + 1),
                             c * std::sin(0.8 * rate * t + 2));
    };
  };
  const auto nowhere = [](double) { return Eigen::Vector3d(1, 2, 3); };
  const auto slow = sines(0.25, 0.2, 0.1, 2);
  struct Motion {
    const char* name;
    Path path;
    double rate, length, rotation_noise, position_noise;
  };
  const std::vector<Motion> motions{
      // A hand that shakes at up to 25 rad/s.
      {"shaken", {sines(0.7, 0.6, 0.5, 22), sines(0.05, 0.04, 0.03, 22)}, 285, 4, 5e-5, 1e-5},
      {"a hand, good poses", {sines(0.35, 0.3, 0.5, 2.7), slow}, 200, 6, 1e-4, 1e-4},
      {"a hand, bad poses", {sines(0.35, 0.3, 0.5, 2.7), slow}, 30, 20, 1e-2, 1e-2},
      {"a hand with a vibration",
       {[](double t) {
          return Eigen::Vector3d(0.35 * std::sin(3.1 * t) + 0.004 * std::sin(60 * t), 0.3 * std::cos(2.3 * t),
                                 0.5 * std::sin(2.7 * t));
        },
        slow},
       250,
       6,
       1e-4,
       1e-4},
      {"turns from rest",
       {[](double t) { return Eigen::Vector3d(0.8 * bump(t, 2, 0.15), 0.5 * bump(t, 4, 0.2), -0.8 * bump(t, 6, 0.1)); },
        slow},
       100,
       8,
       1e-3,
       1e-3},
      {"one turn in a long rest",
       {[](double t) { return Eigen::Vector3d(0, 0.7 * bump(t, 12, 0.1), 0); }, nowhere},
       100,
       20,
       1e-4,
       1e-3},
      {"steady turn", {[](double t) { return Eigen::Vector3d(0, 0, 3 * t); }, nowhere}, 100, 6, 2e-3, 2e-3},
      {"key frames", {sines(0.4, 0.3, 0.5, 0.5), sines(0.4, 0.3, 0.5, 0.5)}, 2, 60, 5e-3, 5e-3},
  };
  for (const Motion& m : motions) {
    const auto poses = poses_of(m.path, m.rate, m.length, m.rotation_noise, m.position_noise);
    const auto chosen = fit<Curve>(poses);
    REQUIRE(chosen.knot_choice);
    const double found = gyro_error(chosen.spline, m.path);
    double best = std::numeric_limits<double>::infinity(), interval = 0;
    for (double h = 1.3 / m.rate; h < std::min(m.length / 8, 64 / m.rate); h *= 1.25) {
      const double error = gyro_error(fit<Curve>(poses, {.knot_interval = h}).spline, m.path);
      if (error < best) {
        best = error;
        interval = h;
      }
    }
    INFO(m.name << ": " << found << " rad/s with " << chosen.knot_choice->interval << " s, best " << best << " with "
                << interval);
    CHECK(chosen.converged);
    CHECK(found <= 1.3 * best);
  }
}
