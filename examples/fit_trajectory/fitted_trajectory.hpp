// SPDX-License-Identifier: MIT
// What comes of a fit, of whichever order, group and knots.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <optional>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/spline/choose_knots.hpp>
#include <splinertia/strapdown/inertial_fit.hpp>
#include <string>
#include <vector>

#include "options.hpp"
#include "support/trajectory_fit.hpp"

/// A sample of the IMU that was there, and what the calibrated curve says to it.
struct SampleResidual {
  std::chrono::nanoseconds time;
  Eigen::Vector3d gyro, accel;                    // of the curve
  Eigen::Vector3d gyro_residual, accel_residual;  // curve − sample
};

struct FittedImu {
  splinertia::CalibratedImu<double> calibrated;
  double gyro_deviation, accel_deviation;  // that the samples were taken to have
  std::vector<SampleResidual> samples{};   // within the curve
};

struct FittedTrajectory {
  std::chrono::nanoseconds start{}, end{};  // of the curve
  std::vector<std::chrono::nanoseconds> knots{};
  std::optional<std::chrono::nanoseconds> interval{};  // of uniform knots
  Poses control_points{};                              // at the times that they belong to
  std::optional<double> chosen_interval{};             // s, by a search
  std::vector<splinertia::KnotIntervalError> tried{};  // by cross-validation

  Poses smoothed{};  // the curve at the times of the poses
  PoseDistances distances{};
  Eigen::Vector3d rotation_deviation{}, position_deviation{};
  std::vector<std::size_t> outliers{};
  std::vector<Gap> gaps{};
  int iterations = 0;
  bool converged = true, ends_held = false;
  double condition = 0;

  std::vector<splinertia::EurocImu> derived{};  // ideal readings along the curve
  std::optional<FittedImu> imu{};
};

/// Fits a curve on G as the options say. Throws what is wrong with poses, samples and options.
template <splinertia::Pose G>
[[nodiscard]] FittedTrajectory fit_trajectory(const Poses& poses, const std::vector<splinertia::EurocImu>& samples,
                                              const Options& options);
extern template FittedTrajectory fit_trajectory<splinertia::SO3xR3<double>>(const Poses&,
                                                                            const std::vector<splinertia::EurocImu>&,
                                                                            const Options&);
extern template FittedTrajectory fit_trajectory<Sophus::SE3d>(const Poses&, const std::vector<splinertia::EurocImu>&,
                                                              const Options&);
