// SPDX-License-Identifier: MIT
// integrate() turns the samples of an IMU back into motion, with the scheme that is named.

#include <cstdio>
#include <splinertia/imu/presets.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

using namespace splinertia;

/// The distance from the truth after 20 s, m. A sample is anything with time, gyro and accel.
template <typename Scheme>
double error(const auto& samples) {
  const Ellipse<> truth;
  const NavState<double> initial = nav_state(truth.evaluate<1>(0.0), 0.0);
  const auto states = integrate<Scheme>(initial, samples);  // `initial`, then one state for each step
  return (states.back().p_WB - position(truth.evaluate<0>(states.back().time).value)).norm();
}

int main() {
  const auto ideal = simulate(Ellipse<>{}, Imu{}, {.rate = 200, .start = 0.0, .end = 20.0});
  const auto noisy = simulate(Ellipse<>{}, presets::euroc, {.rate = 200, .seed = 1, .start = 0.0, .end = 20.0});
  std::puts("scheme    ideal IMU [m]  EuRoC's IMU [m]");
  std::printf("Euler     %13.5f  %15.2f\n", error<Euler>(ideal), error<Euler>(noisy));
  std::printf("Midpoint  %13.5f  %15.2f\n", error<Midpoint>(ideal), error<Midpoint>(noisy));
  std::printf("Magnus4   %13.5f  %15.2f\n", error<Magnus4>(ideal), error<Magnus4>(noisy));
}

// prints
// scheme    ideal IMU [m]  EuRoC's IMU [m]
// Euler           0.90586             2.96
// Midpoint        0.00111             2.28
// Magnus4         0.00000             2.29
