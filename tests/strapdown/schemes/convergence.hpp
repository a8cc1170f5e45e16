// SPDX-License-Identifier: MIT
/// How a scheme's error falls with the sampling interval, on the ellipse and in the aggressive motion.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <vector>

#include "strapdown/aggressive_motion.hpp"
#include "support/catch.hpp"

namespace splinertia::testing {

/// RMS position error, m, of 20 s of the ellipse, integrated from exact samples at `rate`.
template <typename Scheme>
double ellipse_error(double rate) {
  const Ellipse<> motion;
  const auto samples = simulate(motion, Imu{ErrorModel{}, ErrorModel{}}, {.rate = rate, .start = 0.0, .end = 20.0});
  double squares = 0;
  const auto states = integrate<Scheme>(nav_state(motion.evaluate<1>(0), 0.0), samples);
  for (const auto& state : states)
    squares += (state.p_WB - position(motion.evaluate<0>(state.time).value)).squaredNorm();
  return std::sqrt(squares / static_cast<double>(states.size()));
}

/// The order of convergence between two rates.
template <typename Scheme>
double observed_order(double rate, double finer_rate) {
  return std::log(ellipse_error<Scheme>(rate) / ellipse_error<Scheme>(finer_rate)) / std::log(finer_rate / rate);
}

/// Stamps from 0 to 10 s, `rate` of them in a second: at equal intervals, ...
inline std::vector<double> regular_stamps(double rate) {
  std::vector<double> stamps;
  const auto n = static_cast<int>(std::lround(10 * rate));
  for (int i = 0; i <= n; ++i) stamps.push_back(i / rate);
  return stamps;
}

/// ... at intervals of 0.7 and 1.3 by turns, ...
inline std::vector<double> alternating_stamps(double rate) {
  auto stamps = regular_stamps(rate);
  for (std::size_t i = 1; i < stamps.size(); i += 2) stamps[i] -= 0.3 / rate;
  return stamps;
}

/// ... or at random ones, from 0.5 to 1.5 times the mean.
inline std::vector<double> random_stamps(double rate, unsigned seed = 1) {
  std::minstd_rand bits(seed);
  std::vector<double> stamps{0};
  while (stamps.back() < 10) {
    stamps.push_back(stamps.back() + (0.5 + static_cast<double>(bits()) / 2147483648.0) / rate);
  }
  return stamps;
}

/// What a perfect IMU reads at `stamps`.
template <typename Curve>
std::vector<ImuSample<>> point_samples(const Curve& motion, const std::vector<double>& stamps) {
  std::vector<ImuSample<>> samples;
  for (const double t : stamps) {
    const auto imu = ideal_imu(motion.template evaluate<2>(t));
    samples.push_back({t, imu.gyro, imu.accel});
  }
  return samples;
}

/// What a perfect IMU sums up from each stamp to the next, to rounding: by Gauss and Legendre's rule with five points
/// on parts of at most 2.5 ms.
template <typename Curve>
std::vector<ImuIncrement<>> increments(const Curve& motion, const std::vector<double>& stamps) {
  const double near = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, far = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double w_near = (322 + 13 * std::sqrt(70.0)) / 1800, w_far = (322 - 13 * std::sqrt(70.0)) / 1800;
  const std::array<double, 5> nodes{-far, -near, 0, near, far}, weights{w_far, w_near, 64.0 / 225, w_near, w_far};
  std::vector<ImuIncrement<>> result;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double from = stamps[i - 1], whole = stamps[i] - from;
    const int parts = std::max(1, static_cast<int>(std::ceil(whole / 2.5e-3)));
    ImuIncrement<> sum{stamps[i], Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    for (int part = 0; part < parts; ++part) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto imu = ideal_imu(motion.template evaluate<2>(from + whole * (part + (1 + nodes[k]) / 2) / parts));
        sum.delta_angle += imu.gyro * (weights[k] * whole / parts);
        sum.delta_velocity += imu.accel * (weights[k] * whole / parts);
      }
    }
    result.push_back(sum);
  }
  return result;
}

/// The largest position error, m, in the aggressive motion sampled at `stamps`.
template <typename Scheme>
double aggressive_error(const std::vector<double>& stamps) {
  const AggressiveMotion<> motion;
  const auto initial = nav_state(motion.evaluate<1>(stamps.front()), stamps.front());
  double largest = 0;
  const auto compare = [&](const NavState<double>& state) {
    largest = std::max(largest, (state.p_WB - position(motion.evaluate<0>(state.time).value)).norm());
  };
  if constexpr (Scheme::takes_increments) {
    integrate<Scheme>(initial, increments(motion, stamps), standard_gravity<double>(), compare);
  } else {
    integrate<Scheme>(initial, point_samples(motion, stamps), standard_gravity<double>(), compare);
  }
  return largest;
}

/// The order of convergence in the aggressive motion between two rates, with stamps of one kind.
template <typename Scheme>
double aggressive_order(double rate, double finer_rate, const auto& stamps_at) {
  return std::log(aggressive_error<Scheme>(stamps_at(rate)) / aggressive_error<Scheme>(stamps_at(finer_rate))) /
         std::log(finer_rate / rate);
}

/// Whether that is `order` between 100, 200, 400 and 1000 Hz.
template <typename Scheme>
void check_order(double order, const auto& stamps_at) {
  CHECK_THAT(aggressive_order<Scheme>(100, 200, stamps_at), WithinAbs(order, 0.1));
  CHECK_THAT(aggressive_order<Scheme>(200, 400, stamps_at), WithinAbs(order, 0.1));
  CHECK_THAT(aggressive_order<Scheme>(400, 1000, stamps_at), WithinAbs(order, 0.1));
}

/// The same for unequal intervals. Random ones leave noise in the order: it is the mean of five.
template <typename Scheme>
void check_order_of_unequal_intervals(double order) {
  check_order<Scheme>(order, alternating_stamps);
  double mean = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    mean += aggressive_order<Scheme>(100, 1000, [&](double rate) { return random_stamps(rate, seed); }) / 5;
  }
  CHECK_THAT(mean, WithinAbs(order, 0.25));
}

}  // namespace splinertia::testing
