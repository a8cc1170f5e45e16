// SPDX-License-Identifier: MIT
/// The curves that the study compares, behind functions whose types are all the same: what takes long to compile is in
/// one file for each order (order3.cpp, …).
#pragma once

#include <cstddef>
#include <span>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/motion/motion.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>
#include <vector>

#include "study.hpp"

namespace study {

using Poses = std::vector<splinertia::Stamped<splinertia::SO3xR3<double>, double>>;
/// Where a curve should be and what an IMU should read along it.
struct Truth {
  double time;
  splinertia::Motion<splinertia::SO3xR3<double>, 2> motion;
};

/// The length of the error: orientation [rad], position [m], angular velocity [rad/s], specific force [m/s²].
struct CurveErrors {
  ErrorStatistics orientation, position, gyro, accel;
};

struct Subject {
  std::string group;
  int order;
  std::string scalar;
  std::size_t control_points, bytes;  // bytes of a control point and its increment
  CurveErrors errors;
  Kernel single;  // a call: evaluate<2>() and ideal_imu() at one time, in no order
  Kernel dense;   // a call: one sample of sample_imu()
};

/// Between the times at which sample_imu() is measured, s.
inline constexpr double dense_interval = 1e-3;

/// Curves of this order on both groups, each in float, double and long double: fitted in double to the poses, with
/// knots so far apart, and compared with the truth.
template <int Order>
[[nodiscard]] std::vector<Subject> subjects(const Poses& poses, double knot_interval, std::span<const Truth> truth);
extern template std::vector<Subject> subjects<3>(const Poses&, double, std::span<const Truth>);
extern template std::vector<Subject> subjects<4>(const Poses&, double, std::span<const Truth>);
extern template std::vector<Subject> subjects<5>(const Poses&, double, std::span<const Truth>);
extern template std::vector<Subject> subjects<6>(const Poses&, double, std::span<const Truth>);
extern template std::vector<Subject> subjects<7>(const Poses&, double, std::span<const Truth>);
extern template std::vector<Subject> subjects<8>(const Poses&, double, std::span<const Truth>);

/// A curve of order 6 through measured poses, which takes the place of the truth.
[[nodiscard]] splinertia::Spline<splinertia::SO3xR3<double>, 6> smooth_curve(const Poses& poses, double knot_interval);

}  // namespace study
