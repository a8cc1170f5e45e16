// SPDX-License-Identifier: MIT
// The largest angular velocity and specific force of a fitted curve, and those that the poses show without it. A curve
// that is wild, or too stiff, differs from its poses here by far more than in the residuals.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "support/fitted_trajectory.hpp"

struct Peak {
  double value = -1;  // < 0: there was nothing to take the largest of
  std::chrono::nanoseconds time{};
};

/// |ω|, rad/s, and |f|, m/s².
struct Peaks {
  Peak gyro, accel;
};

/// Standard deviations of poses on their noisiest axis; infinite where there are too few poses to find them.
struct PoseNoise {
  double rotation = 0, position = 0;  // rad, m
};

struct Extremes {
  Peaks measured;                   // of the curve, outside of holes
  std::optional<Peaks> invented;    // of the curve inside holes
  Peaks differences;                // of the poses
  std::chrono::nanoseconds window;  // of the second differences: to the pose before, and to that behind
  PoseNoise noise;
  double gyro_noise, accel_noise;  // the largest differences that this noise alone makes, about
};

/// The curve is evaluated `rate` times a second, and at least 4 times in each segment. The differences are those of
///   |ω|: neighbouring poses, their turn over their interval;
///   |f|: positions at t − window, t, t + window, the second difference minus gravity. The window is at least a knot
///        interval, or 0.05 s where that is longer, and so long that noise makes at most about 2 m/s².
/// Outliers and poses on both sides of a hole make none.
[[nodiscard]] Extremes extremes(const Poses& poses, const FittedTrajectory& fitted, const Eigen::Vector3d& gravity,
                                double rate);

/// The table of them, `first` being the time that they are counted from.
[[nodiscard]] std::string extremes_text(const Extremes& found, std::chrono::nanoseconds first);

/// A sentence for each disagreement that noise does not explain.
[[nodiscard]] std::vector<std::string> extremes_warnings(const Extremes& found, const FittedTrajectory& fitted);
