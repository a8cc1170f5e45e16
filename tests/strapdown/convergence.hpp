// SPDX-License-Identifier: MIT
/// How a scheme's error falls with the sampling interval.
#pragma once

#include <cmath>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrate.hpp>

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

}  // namespace splinertia::testing
