// SPDX-License-Identifier: MIT
// The largest angular velocity and specific force of a fitted curve, and those of the differences of its poses. For a
// curve that oscillates or is too stiff, these differ far more than the residuals show.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "support/fitted_trajectory.hpp"

struct Peak {
  double value = -1;  // < 0: no values
  std::chrono::nanoseconds time{};
};

/// |ω|, rad/s, and |f|, m/s².
struct Peaks {
  Peak gyro, accel;
};

/// Standard deviations of poses on their noisiest axis; infinite if there are too few poses to estimate them.
struct PoseNoise {
  double rotation = 0, position = 0;  // rad, m
};

struct Extremes {
  Peaks measured;                   // of the curve, outside of holes
  std::optional<Peaks> invented;    // of the curve inside holes
  Peaks differences;                // of the poses
  std::chrono::nanoseconds window;  // time step of the second differences
  PoseNoise noise;
  double gyro_noise, accel_noise;  // about the largest differences that this noise alone makes
};

/// Evaluates the curve `rate` times a second, and at least 4 times in each segment. The differences of the poses are
///   |ω|: the rotation between neighbouring poses, divided by their interval;
///   |f|: the second difference of the positions at t − window, t and t + window, minus gravity. The window is at least
///        the smaller of a knot interval and 0.05 s, and so long that noise makes at most about 2 m/s².
/// Outliers are not used, and no difference spans a hole.
[[nodiscard]] Extremes extremes(const Poses& poses, const FittedTrajectory& fitted, const Eigen::Vector3d& gravity,
                                double rate);

/// The table of the extremes, with times counted from `first`.
[[nodiscard]] std::string extremes_text(const Extremes& found, std::chrono::nanoseconds first);

/// A sentence for each disagreement that noise does not explain.
[[nodiscard]] std::vector<std::string> extremes_warnings(const Extremes& found, const FittedTrajectory& fitted);
