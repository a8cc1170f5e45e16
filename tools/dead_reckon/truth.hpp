// SPDX-License-Identifier: MIT
// The true states of a body, from a trajectory file.
#pragma once

#include <chrono>
#include <optional>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/strapdown/nav_state.hpp>
#include <splinertia/strapdown/preintegration/bias_jacobians.hpp>
#include <string>
#include <vector>

#include "dead_reckon/options.hpp"

using State = splinertia::NavState<double, std::chrono::nanoseconds>;

/// The true state and biases at one time.
struct Truth {
  State state;
  splinertia::ImuBias<double> bias;
};

/// The true states of a trajectory file, in ascending order of time.
struct TrueStates {
  std::vector<Truth> rows;
  bool with_velocities, with_biases;  // whether the file has them; else velocities are from poses, biases unknown
  std::string notes;                  // on how the file was read
};

/// Throws std::runtime_error if the file yields no state.
[[nodiscard]] TrueStates read_truth(const Options& options);

/// The truth at a time. Between two rows the position is the cubic through their positions and velocities; the rest is
/// interpolated linearly. Nothing outside the rows or in a gap longer than `longest_gap` (s).
[[nodiscard]] std::optional<Truth> at(const TrueStates& truth, std::chrono::nanoseconds time, double longest_gap);

/// The state of an IMU mounted on the body, with l = p_BI and the body's angular velocity ω in body axes:
///   R_WI = R_WB R_BI,  p_WI = p_WB + R_WB l,  v_WI = v_WB + R_WB (ω × l)
[[nodiscard]] State imu_state(const State& body, const splinertia::Mounting<double>& mounting,
                              const Eigen::Vector3d& omega);
