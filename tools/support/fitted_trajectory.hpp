// SPDX-License-Identifier: MIT
// The fit of a curve to the poses of a file, for any order, group and knots, and its results.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <splinertia/calibration/inertial_fit.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/spline/fit/choose_knots.hpp>
#include <string>
#include <vector>

#include "support/any_trajectory.hpp"
#include "support/fit_choices.hpp"
#include "support/holes.hpp"
#include "support/pose_distances.hpp"
#include "support/trajectory_input.hpp"

/// Poses, the name of their file for messages, and lines on how it was read.
struct FitInput {
  std::filesystem::path file;
  Poses poses;
  std::string notes{};
};
[[nodiscard]] FitInput read_fit_input(const TrajectoryInput& input);

/// A recorded IMU: its samples, and how to calibrate it.
struct FitImu {
  std::filesystem::path file;
  std::vector<splinertia::ImuSample<double, std::chrono::nanoseconds>> samples{};
  std::optional<double> gyro_deviation{}, accel_deviation{};  // of a sample, rad/s, m/s²; default: from residuals
  bool estimate_lever_arm = false, estimate_time_offset = false;
  bool fit_together = false;  // also fit the curve to the samples
  Eigen::Vector3d gravity{0, 0, -9.80665};
};

/// The reading that the curve and the calibration predict for a sample of a recorded IMU, and the residuals.
struct SampleResidual {
  std::chrono::nanoseconds time;
  Eigen::Vector3d gyro, accel;                    // of the curve
  Eigen::Vector3d gyro_residual, accel_residual;  // curve − sample
  bool invented;                                  // inside a hole
};

struct FittedImu {
  splinertia::CalibratedImu<double> calibrated;
  double gyro_deviation, accel_deviation;  // standard deviations assumed for a sample
  std::vector<SampleResidual> samples{};   // within the curve
};

struct FittedTrajectory {
  AnyTrajectory curve{};
  std::vector<std::chrono::nanoseconds> knots{};       // of non-uniform knots
  std::optional<std::chrono::nanoseconds> interval{};  // of uniform knots
  std::string why_interval{};                          // why the program chose it; empty if it did not
  Poses control_points{};                              // at their times
  std::optional<double> chosen_interval{};             // s, found by a search
  std::vector<splinertia::KnotIntervalError> tried{};  // by cross-validation

  Poses smoothed{};  // the curve at the times of the poses
  PoseDistances distances{};
  Eigen::Vector3d rotation_deviation{}, position_deviation{};
  std::vector<std::size_t> outliers{};
  std::vector<Hole> holes{};                   // where no poses measure the curve
  std::size_t regularized_control_points = 0;  // control points that poses alone do not determine
  int iterations = 0;
  bool converged = true;
  double condition = 0;
  std::optional<FittedImu> imu{};

  /// Where the segments of the curve begin and end, strictly ascending.
  [[nodiscard]] std::vector<std::chrono::nanoseconds> breaks() const;
};

/// Fits a curve with the given choices; `imu` may be null. Throws std::runtime_error or std::invalid_argument if poses,
/// samples or choices cannot be used.
[[nodiscard]] FittedTrajectory fit_trajectory(const FitInput& input, const FitChoices& choices, const FitImu* imu);

/// What has not converged, in one sentence, so that the result needs --accept. Empty if everything has converged.
[[nodiscard]] std::string not_converged(const FittedTrajectory& fitted, const FitChoices& choices);
