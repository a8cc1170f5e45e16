// SPDX-License-Identifier: MIT
// The fit of a curve to the poses of a file, of whichever order, group and knots, and what comes of it.
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

/// Poses, the file that messages name, and lines on how it was read.
struct FitInput {
  std::filesystem::path file;
  Poses poses;
  std::string notes{};
};
[[nodiscard]] FitInput read_fit_input(const TrajectoryInput& input);

/// An IMU that was there: its samples, and how it is calibrated.
struct FitImu {
  std::filesystem::path file;
  std::vector<splinertia::EurocImu> samples{};
  std::optional<double> gyro_deviation{}, accel_deviation{};  // of a sample, rad/s, m/s²; default: of the residuals
  bool estimate_lever_arm = false, estimate_time_offset = false;
  bool fit_together = false;  // fit the curve to its samples, too
  Eigen::Vector3d gravity{0, 0, -9.80665};
};

/// A sample of the IMU that was there, and what the calibrated curve says to it.
struct SampleResidual {
  std::chrono::nanoseconds time;
  Eigen::Vector3d gyro, accel;                    // of the curve
  Eigen::Vector3d gyro_residual, accel_residual;  // curve − sample
  bool invented;                                  // the curve is that of a hole
};

struct FittedImu {
  splinertia::CalibratedImu<double> calibrated;
  double gyro_deviation, accel_deviation;  // that the samples were taken to have
  std::vector<SampleResidual> samples{};   // within the curve
};

struct FittedTrajectory {
  AnyTrajectory curve{};
  std::vector<std::chrono::nanoseconds> knots{};       // of non-uniform knots
  std::optional<std::chrono::nanoseconds> interval{};  // of uniform knots
  std::string why_interval{};                          // why the program chose it, where it did
  Poses control_points{};                              // at the times that they belong to
  std::optional<double> chosen_interval{};             // s, by a search
  std::vector<splinertia::KnotIntervalError> tried{};  // by cross-validation

  Poses smoothed{};  // the curve at the times of the poses
  PoseDistances distances{};
  Eigen::Vector3d rotation_deviation{}, position_deviation{};
  std::vector<std::size_t> outliers{};
  std::vector<Hole> holes{};            // where the curve is invented
  std::size_t held_control_points = 0;  // that the poses alone do not determine
  int iterations = 0;
  bool converged = true;
  double condition = 0;
  std::optional<FittedImu> imu{};

  /// Where the segments of the curve begin and end, strictly ascending.
  [[nodiscard]] std::vector<std::chrono::nanoseconds> breaks() const;
};

/// Fits a curve as the choices say; `imu` may be none. Throws what is wrong with poses, samples and choices.
[[nodiscard]] FittedTrajectory fit_trajectory(const FitInput& input, const FitChoices& choices, const FitImu* imu);

/// Why the result should not be used without --accept: what has not converged, in one sentence. Empty if all has.
[[nodiscard]] std::string not_converged(const FittedTrajectory& fitted, const FitChoices& choices);
