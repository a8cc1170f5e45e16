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

/// What is known to be true at a time.
struct Truth {
  State state;
  splinertia::ImuBias<double> bias;
};

/// What a trajectory file says, in the order of time.
struct TrueStates {
  std::vector<Truth> rows;
  bool with_velocities, with_biases;  // of the file; else velocities are from its poses, and biases unknown
  std::string notes;                  // on how the file was read
};

/// Throws std::runtime_error if the file does not give a single state.
[[nodiscard]] TrueStates read_truth(const Options& options);

/// The truth at a time: between two rows the cubic of their positions and velocities, and linear in the rest; nothing
/// outside the rows or in a gap between them.
[[nodiscard]] std::optional<Truth> at(const TrueStates& truth, std::chrono::nanoseconds time, double longest_gap);

/// The state of an IMU that is mounted on the body. With l = p_BI and the body's angular velocity ω, in its own axes:
///   R_WI = R_WB R_BI,  p_WI = p_WB + R_WB l,  v_WI = v_WB + R_WB (ω × l)
[[nodiscard]] State imu_state(const State& body, const splinertia::LeverArm<double>& arm, const Eigen::Vector3d& omega);
