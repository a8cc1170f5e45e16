// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/rotating_frame.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <vector>

#include "strapdown/schemes/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Sample = ImuSample<>;
using Turning = IntegrationOptions<double, RotatingFrame<double>>;
const Eigen::Vector3d nothing(0, 0, 0);
const Eigen::Vector3d earth_rate = 7.292115e-5 * Eigen::Vector3d(0, std::cos(0.8), std::sin(0.8));  // at latitude 0.8

std::vector<Sample> constant_samples(const Eigen::Vector3d& gyro, const Eigen::Vector3d& accel, double end, int n) {
  std::vector<Sample> samples;
  for (int i = 0; i <= n; ++i) samples.push_back({end * i / n, gyro, accel});
  return samples;
}

/// The aggressive motion as one relative to a world that turns: the largest position error, m.
template <typename Scheme>
double turning_error(const Eigen::Vector3d& rate, double sampling_rate, const Turning& options) {
  const testing::AggressiveMotion<> motion;
  const Eigen::Vector3d gravity = standard_gravity<double>();
  auto samples = testing::point_samples(motion, testing::regular_stamps(sampling_rate));
  for (auto& sample : samples) {
    const auto m = motion.evaluate<2>(sample.time);
    const auto to_body = rotation(m.value).inverse();
    sample.gyro += to_body * rate;
    sample.accel += to_body * (2 * rate.cross(world_velocity(m)));
  }
  double largest = 0;
  integrate<Scheme>(
      nav_state(motion.evaluate<1>(0), 0.0), samples, gravity,
      [&](const NavState<double>& state) {
        largest = std::max(largest, (state.p_WB - position(motion.evaluate<0>(state.time).value)).norm());
      },
      options);
  return largest;
}

}  // namespace

TEST_CASE("The attitude in a turning world is exact") {
  const Eigen::Vector3d rate(0.3, -0.2, 0.5), gyro(1, 2, -1);
  const Sophus::SO3d R = Sophus::SO3d::exp({0.1, 0.2, 0.3});
  const auto states = integrate<Midpoint>(NavState<double>{R, nothing, nothing, 0},
                                          constant_samples(gyro, nothing, 4, 100), nothing, Turning{.frame = {rate}});
  const Sophus::SO3d truth = Sophus::SO3d::exp(-4 * rate) * R * Sophus::SO3d::exp(4 * gyro);
  CHECK((truth.inverse() * states.back().R_WB).log().norm() < 1e-13);
}

TEST_CASE("Without forces a body's velocity turns twice as fast as the world, the other way") {
  // v' = -2 Ω × v. About the z axis: v turns by -2 Ω t, and p goes around a circle of inertia of radius |v|/(2 Ω).
  const double w = 0.5;
  const Eigen::Vector3d v(3, 0, 1);
  const auto error = [&](int n) {
    const auto state =
        integrate<Midpoint>(NavState<double>{{}, v, nothing, 0}, constant_samples(nothing, nothing, 5, n), nothing,
                            Turning{.frame = {{0, 0, w}}})
            .back();
    const double angle = -2 * w * 5;
    const Eigen::Vector3d v_truth(3 * std::cos(angle), 3 * std::sin(angle), 1);
    const Eigen::Vector3d p_truth(3 / (2 * w) * -std::sin(angle), -3 / (2 * w) * (1 - std::cos(angle)), 5);
    return std::pair((state.v_WB - v_truth).norm(), (state.p_WB - p_truth).norm());
  };
  const auto coarse = error(100), fine = error(200);
  CHECK(coarse.first < 0.01);
  CHECK_THAT(std::log2(coarse.first / fine.first), WithinAbs(2, 0.1));
  CHECK_THAT(std::log2(coarse.second / fine.second), WithinAbs(2, 0.1));
}

TEST_CASE("A body at rest in inertial space goes around the axis of a turning world") {
  // Its gravity is the centrifugal acceleration alone, -Ω × (Ω × p), here that of the middle of a step.
  const Eigen::Vector3d rate(0, 0, 0.5), p(2, 0, 1);
  const auto error = [&](int n) {
    const RotatingFrame<double> frame{rate};
    const double h = 10.0 / n;
    const NavIncrement<double> increment{Eigen::Quaterniond::Identity(), nothing, nothing, h};
    NavState<double> state{{}, -rate.cross(p), p, 0};
    for (int i = 1; i <= n; ++i) {
      const Eigen::Vector3d middle = Sophus::SO3d::exp(-rate * (h * (i - 0.5))) * p;
      state = frame.advance(state, increment, Eigen::Vector3d(-rate.cross(rate.cross(middle))), h * i);
    }
    const Sophus::SO3d turned = Sophus::SO3d::exp(-rate * 10);
    CHECK((turned.inverse() * state.R_WB).log().norm() < 1e-13);
    CHECK((state.v_WB + rate.cross(turned * p)).norm() < 0.1 * h);
    return (state.p_WB - turned * p).norm();
  };
  CHECK(error(100) < 0.02);
  CHECK_THAT(std::log2(error(100) / error(200)), WithinAbs(2, 0.1));
}

TEST_CASE("A body at rest on the Earth stays there only where its rotation is minded") {
  const NavState<double> initial{Sophus::SO3d::exp({0.1, -0.2, 0.3}), nothing, {10, 20, 30}, 0};
  const Eigen::Vector3d gravity = standard_gravity<double>();
  const auto samples =
      constant_samples(initial.R_WB.inverse() * earth_rate, initial.R_WB.inverse() * -gravity, 100, 20000);
  const auto state = integrate<Midpoint>(initial, samples, gravity, Turning{.frame = {earth_rate}}).back();
  // The attitude is rounded 20000 times; what it is off by tilts gravity for 100 s.
  const double tilt = 20000 * std::numeric_limits<double>::epsilon();
  CHECK((initial.R_WB.inverse() * state.R_WB).log().norm() < tilt);
  CHECK(state.v_WB.norm() < 10 * tilt * 100);
  CHECK((state.p_WB - initial.p_WB).norm() < 10 * tilt * 100 * 100 / 2);
  CHECK((integrate<Midpoint>(initial, samples, gravity).back().p_WB - initial.p_WB).norm() > 50);
}

TEST_CASE("In aggressive motion over the Earth Magnus4 keeps its order and error") {
  const Turning earth{.frame = {earth_rate}};
  const double e100 = turning_error<Magnus4>(earth_rate, 100, earth),
               e200 = turning_error<Magnus4>(earth_rate, 200, earth),
               e400 = turning_error<Magnus4>(earth_rate, 400, earth);
  CHECK(e200 < 1.55e-3);
  CHECK_THAT(std::log2(e100 / e200), WithinAbs(4, 0.1));
  CHECK_THAT(std::log2(e200 / e400), WithinAbs(4, 0.1));
}

TEST_CASE("What is left out is of second order in the rate of the world") {
  const Eigen::Vector3d rate(0.1, -0.2, 0.2);
  const double e400 = turning_error<Magnus4>(rate, 400, {.frame = {rate}}),
               e800 = turning_error<Magnus4>(rate, 800, {.frame = {rate}});
  CHECK(e400 < 1e-3);
  CHECK(e800 < e400 / 3.8);
}

TEST_CASE("A world that does not turn is the inertial one") {
  const double turning = turning_error<Magnus4>(nothing, 100, {.frame = {nothing}});
  CHECK_THAT(turning, WithinRel(testing::aggressive_error<Magnus4>(testing::regular_stamps(100)), 1e-9));
  STATIC_CHECK(std::is_same_v<decltype(RotatingFrame{earth_rate}), RotatingFrame<double>>);
  STATIC_CHECK(sizeof(RotatingFrame<double>) == sizeof(Eigen::Vector3d));
}
