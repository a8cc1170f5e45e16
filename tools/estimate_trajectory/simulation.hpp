// SPDX-License-Identifier: MIT
// The motion to estimate, what is measured along it, and the first guess.
#pragma once

#include <Eigen/Core>
#include <splinertia/splinertia.hpp>
#include <vector>

#include "estimate_trajectory/options.hpp"

inline constexpr int order = 4;
using Group = splinertia::SO3xR3<double>;
using Curve = splinertia::Spline<Group, order>;

/// Motion, biases and gravity: the true values, or an estimate of them.
struct Estimate {
  splinertia::UniformKnots<double> knots;
  std::vector<Sophus::SO3d> rotations;
  std::vector<Eigen::Vector3d> positions;
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();               // rad/s
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();              // m/s²
  Eigen::Vector3d gravity = splinertia::standard_gravity<double>();  // m/s²

  [[nodiscard]] Curve curve() const {
    std::vector<Group> control_points;
    for (std::size_t i = 0; i < rotations.size(); ++i) control_points.emplace_back(rotations[i], positions[i]);
    return {knots, control_points};
  }
};

struct Measurements {
  std::vector<splinertia::Stamped<Group, double>> poses;
  std::vector<splinertia::ImuReading> imu;
};

/// An agile flight around the origin. Control point i belongs to the time of i - 1 knot intervals.
[[nodiscard]] Estimate true_motion(const Options& options);

[[nodiscard]] Measurements measure(const Estimate& truth, const Options& options);

/// The initial estimate: control points interpolated from the measured poses, zero biases, tilted gravity.
[[nodiscard]] Estimate first_guess(const Measurements& measurements, const Estimate& truth, const Options& options);
