// SPDX-License-Identifier: MIT
// IMU samples with any stamps and readings, through every scheme.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/preintegration/preintegrator.hpp>
#include <splinertia/strapdown/schemes/coning_sculling.hpp>
#include <splinertia/strapdown/schemes/euler.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>
#include <splinertia/strapdown/schemes/runge_kutta4.hpp>
#include <splinertia/strapdown/schemes/trapezoid.hpp>
#include <splinertia/strapdown/schemes/zero_order_hold.hpp>
#include <type_traits>
#include <vector>

#include "fuzz/motions.hpp"

namespace splinertia::fuzz::integrate_target {

/// What point samples and increments have.
template <typename Time>
struct AnySample {
  Time time;
  Eigen::Vector3d gyro, accel, delta_angle, delta_velocity;
};

/// Samples a few milliseconds apart, some in bursts, some behind gaps, some not in order.
template <typename Time>
std::vector<AnySample<Time>> samples_of(Numbers& numbers, Time time) {
  constexpr std::array steps{5e-3, 5e-3, 5e-3, 1e-9, 1e-6, 1e-3, 0.1, 10.0};
  std::vector<AnySample<Time>> samples;
  while (!numbers.input.empty() && samples.size() < 24) {
    const auto gyro = numbers.vector(), accel = numbers.vector();
    samples.push_back({time, gyro, accel, gyro * 5e-3, accel * 5e-3});
    if (numbers.wild && numbers.input.integer(0, 15) == 0) {
      time = numbers.time<Time>();
    } else {
      time = after(time, steps[static_cast<std::size_t>(numbers.input.integer(0, steps.size() - 1))]);
    }
  }
  return samples;
}

template <typename Scheme, typename Time>
void use(Numbers& numbers) {
  NavState<double, Time> initial;
  initial.R_WB = numbers.rotation();
  initial.v_WB = numbers.vector();
  initial.p_WB = numbers.vector();
  initial.time = numbers.wild ? numbers.time<Time>() : Time{};
  const Eigen::Vector3d gravity = numbers.vector();
  const bool bridge = numbers.input.flag();
  std::vector<AnySample<Time>> samples = samples_of(numbers, initial.time);
  GapOptions<double> gaps;
  if (bridge) gaps = {1, GapPolicy::bridge};

  std::vector<NavState<double, Time>> states;
  const bool done = accepted("integrate: ", [&] {
    auto measured = samples;
    if (Scheme::takes_increments && !measured.empty())
      measured.erase(measured.begin());  // they end where the next begins
    states = integrate<Scheme>(initial, measured, gravity, {.gaps = gaps});
  });
  // From an attitude that is off SO(3) it goes on as far off.
  const bool rotation = std::abs(initial.R_WB.unit_quaternion().norm() - 1) < 1e-12;
  if (done && !states.empty() && numbers.usual && rotation) {
    // No scheme makes more of readings than twice the largest of them all along, turned any way, and half of that again
    // of how they turn within a step; but for steps in which they turn by more than a radian, of which the schemes,
    // which are series in that angle, say nothing.
    double force = 0, rate = 0, longest = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      force = std::max(force, samples[i].accel.norm());
      rate = std::max(rate, samples[i].gyro.norm());
      if (i > 0) longest = std::max(longest, to_seconds<double>(samples[i].time - samples[i - 1].time));
    }
    const bool bounded = rate * longest < 1;
    for (const auto& state : states) {
      const double elapsed = to_seconds<double>(state.time - initial.time);
      const double most =
          initial.v_WB.norm() + (gravity.norm() + (Scheme::takes_increments ? 1e9 : 3 * force)) * elapsed;
      const double speed = state.v_WB.norm();
      expect(std::isfinite(speed) && state.p_WB.allFinite(), "a state that is not finite");
      expect(std::abs(state.R_WB.unit_quaternion().norm() - 1) < 1e-9, "a rotation that is none");
      expect(!bounded || speed <= most * (1 + 1e-9) + 1e-9, "speed ", speed, " after ", elapsed,
             " s, expected at most ", most);
    }
  }
  if constexpr (std::is_same_v<Scheme, Midpoint> || std::is_same_v<Scheme, Magnus4> ||
                std::is_same_v<Scheme, TwoSampleIncrements>) {
    std::optional<Preintegrator<Scheme, double, Time, ImuNoise<double>>> preintegrator;
    const bool finished = accepted("preintegrate: ", [&] {
      preintegrator.emplace(initial.time, ImuBias<double>{}, ImuNoise<double>{1e-3, 1e-2, 1e-5, 1e-4}, gaps);
      for (std::size_t i = Scheme::takes_increments ? 1 : 0; i < samples.size(); ++i) preintegrator->push(samples[i]);
      preintegrator->finish();
    });
    expect(finished == done || numbers.wild, "integrate() and Preintegrator do not agree on what is refused");
    if (finished && numbers.usual) {
      const auto& result = preintegrator->result();
      expect(result.delta().velocity.allFinite() && result.delta().position.allFinite(), "a motion that is not finite");
      expect(result.covariance().matrix().allFinite(), "a covariance that is not finite");
    }
  }
}

// What is the same for all schemes is tried with nanoseconds for two of them only: each is a second of compilation.
const Target target{"integrate", [](Input input) {
                      const int scheme = input.integer(0, 12);
                      Numbers numbers{input};
                      switch (scheme) {
                        case 0:
                          return use<Euler, double>(numbers);
                        case 1:
                          return use<Midpoint, double>(numbers);
                        case 2:
                          return use<Trapezoid, double>(numbers);
                        case 3:
                          return use<RungeKutta4, double>(numbers);
                        case 4:
                          return use<RungeKutta4DoubleStep, double>(numbers);
                        case 5:
                          return use<Magnus4, double>(numbers);
                        case 6:
                          return use<ZeroOrderHold, double>(numbers);
                        case 7:
                          return use<UncorrectedIncrements, double>(numbers);
                        case 8:
                          return use<RotationCorrectedIncrements, double>(numbers);
                        case 9:
                          return use<TwoSampleIncrements, double>(numbers);
                        case 10:
                          return use<ThreeSampleIncrements, double>(numbers);
                        case 11:
                          return use<Magnus4, std::chrono::nanoseconds>(numbers);
                        default:
                          return use<TwoSampleIncrements, std::chrono::nanoseconds>(numbers);
                      }
                    }};

}  // namespace splinertia::fuzz::integrate_target
