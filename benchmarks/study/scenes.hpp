// SPDX-License-Identifier: MIT
/// The analytic motions of the study: what people hold, fly and drive, as sums of sines, which are smooth and whose
/// derivatives are exact. Frequencies have no common multiple of interest, so that nothing repeats within a run.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <splinertia/motion/euler_angles.hpp>
#include <splinertia/motion/split_motion.hpp>
#include <string>
#include <vector>

namespace study {

/// amplitude · sin(2π frequency t + phase)
struct Wave {
  double amplitude;  // m or rad
  double frequency;  // Hz
  double phase = 0;  // rad
};

/// A coordinate: a steady change and waves upon it.
struct Coordinate {
  double slope = 0;  // m/s or rad/s
  std::vector<Wave> waves{};

  /// Value and first three derivatives.
  [[nodiscard]] std::array<double, 4> at(double t) const {
    std::array<double, 4> result{slope * t, slope, 0, 0};
    for (const auto& [amplitude, frequency, phase] : waves) {
      const double w = 2 * std::numbers::pi * frequency;
      const double s = amplitude * std::sin(w * t + phase), c = amplitude * std::cos(w * t + phase);
      result[0] += s;
      result[1] += w * c;
      result[2] -= w * w * s;
      result[3] -= w * w * w * c;
    }
    return result;
  }
};

/// A rigid body on waves; a splinertia::Trajectory.
struct Scene {
  using Scalar = double;
  using Group = splinertia::SO3xR3<double>;
  using Time = double;

  std::string name;
  Coordinate x{}, y{}, z{};           // m
  Coordinate yaw{}, pitch{}, roll{};  // rad
  bool heads_along_path = false;      // yaw is that of the velocity, and the waves of `yaw` upon it

  [[nodiscard]] static Time start() { return -std::numeric_limits<double>::infinity(); }
  [[nodiscard]] static Time end() { return std::numeric_limits<double>::infinity(); }

  template <int D>
    requires(D <= 2)
  [[nodiscard]] splinertia::Motion<Group, D> evaluate(Time t) const {
    const auto [px, vx, ax, jx] = x.at(t);
    const auto [py, vy, ay, jy] = y.at(t);
    const auto [pz, vz, az, jz] = z.at(t);
    const auto angle = [t](const Coordinate& c) {
      const auto values = c.at(t);
      return splinertia::AngleMotion<double>{values[0], values[1], values[2]};
    };
    splinertia::EulerAngles<double> attitude{angle(yaw), angle(pitch), angle(roll)};
    if (heads_along_path) {  // atan2(vy, vx) and its derivatives
      const double square = vx * vx + vy * vy, rate = (vx * ay - vy * ax) / square;
      attitude.yaw.angle += std::atan2(vy, vx);
      attitude.yaw.rate += rate;
      attitude.yaw.acceleration += (vx * jy - vy * jx - 2 * rate * (vx * ax + vy * ay)) / square;
    }
    splinertia::RigidBodyState<double> state;
    state.q_WB = attitude.quaternion();
    state.p_WB = {px, py, pz};
    state.omega = attitude.angular_velocity();
    state.v_WB = {vx, vy, vz};
    state.alpha = attitude.angular_acceleration();
    state.a_WB = {ax, ay, az};
    return splinertia::split_motion<D>(state);
  }
};

/// Somebody looks around with a phone: swings at 0.3 to 1.7 Hz, up to 3 rad/s and 1 g beside gravity, and the tremor of
/// a hand, 0.1 mm and 1 mrad at 8 to 9 Hz.
[[nodiscard]] inline Scene hand_held() {
  return {.name = "hand_held",
          .x = {.waves = {{0.25, 0.31}, {0.06, 1.13, 0.4}, {1e-4, 8.3, 1.0}}},
          .y = {.waves = {{0.20, 0.43, 1.1}, {0.05, 1.37, 2.0}, {1e-4, 8.9, 0.2}}},
          .z = {.waves = {{0.08, 0.57, 0.3}, {0.03, 1.71, 1.2}, {1e-4, 9.1, 2.5}}},
          .yaw = {.waves = {{0.70, 0.29}, {0.15, 1.07, 0.7}, {1e-3, 8.1, 0.3}}},
          .pitch = {.waves = {{0.30, 0.47, 0.9}, {0.10, 1.31, 0.1}, {1e-3, 8.7, 1.4}}},
          .roll = {.waves = {{0.25, 0.37, 2.1}, {0.08, 1.61, 1.6}, {1e-3, 9.3, 2.2}}}};
}

/// A racing drone: 3 m turns at 0.4 to 0.9 Hz, up to 4 g and 10 rad/s, leaning into them; its controller corrects at
/// 4 Hz, its frame shakes by 3 mrad and 0.05 mm at 13 to 15 Hz. (What rotors do at 100 Hz and more no spline of
/// sensible knots follows: RandomVibration and SinusoidalVibration are for that.)
[[nodiscard]] inline Scene drone() {
  return {.name = "drone",
          .x = {.waves = {{3.0, 0.41}, {0.35, 0.93, 1.0}, {5e-5, 13.1, 0.3}}},
          .y = {.waves = {{2.0, 0.53, 0.8}, {0.30, 0.97, 2.2}, {5e-5, 14.3, 1.3}}},
          .z = {.waves = {{0.8, 0.61, 0.2}, {0.15, 1.27, 0.5}, {5e-5, 14.9, 0.9}}},
          .yaw = {.slope = 1.5, .waves = {{0.5, 0.67, 0.3}, {0.02, 3.9, 1.0}, {3e-3, 13.7, 0.1}}},
          .pitch = {.waves = {{-0.9, 0.41}, {0.30, 1.49, 0.6}, {0.03, 4.3, 0.2}, {3e-3, 13.3, 2.0}}},
          .roll = {.waves = {{0.9, 0.53, 0.8}, {0.45, 1.61, 1.9}, {0.03, 4.1, 1.7}, {3e-3, 14.7, 0.5}}}};
}

/// A robot on wheels drives an eight of 12 m × 6 m in 25 s, along its heading; the floor shakes it: 2 mm at 2.3 Hz on
/// its tyres, 0.02 mm and 0.3 mrad at 11 to 13 Hz.
[[nodiscard]] inline Scene wheeled_robot() {
  return {.name = "wheeled_robot",
          .x = {.waves = {{6.0, 0.04}}},
          .y = {.waves = {{3.0, 0.08}}},
          .z = {.waves = {{2e-3, 2.3, 0.4}, {2e-5, 11.3, 1.0}}},
          .yaw = {.waves = {{1e-3, 1.9, 0.5}, {3e-4, 12.1, 0.9}}},
          .pitch = {.waves = {{4e-3, 2.7, 0.1}, {3e-4, 11.9, 0.3}}},
          .roll = {.waves = {{3e-3, 2.1, 1.2}, {3e-4, 12.7, 2.1}}},
          .heads_along_path = true};
}

[[nodiscard]] inline std::vector<Scene> scenes() { return {hand_held(), drone(), wheeled_robot()}; }

}  // namespace study
