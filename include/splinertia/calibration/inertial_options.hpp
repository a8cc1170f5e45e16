// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/calibration/imu_calibration.hpp>

namespace splinertia {

/// What is known about an IMU, and which parts of its calibration are estimated.
template <typename Scalar>
struct InertialOptions {
  /// Standard deviation of a sample about the curve, rad/s and m/s²; N √rate for white noise of density N. Include what
  /// the curve cannot follow (vibration between its knots).
  Scalar gyro_standard_deviation = Scalar(0);   ///< has to be given
  Scalar accel_standard_deviation = Scalar(0);  ///< has to be given
  /// The initial values; what is not estimated keeps them.
  ImuCalibration<Scalar> calibration{};
  bool estimate_gyro_bias = true;
  bool estimate_accel_bias = true;
  bool estimate_gravity_direction = true;  ///< its magnitude is kept
  /// p_BI; R_BI is kept. Lever arm and time offset are observable only if the body moves. At rest, they are fitted to
  /// the noise that the curve follows.
  bool estimate_lever_arm = false;
  bool estimate_time_offset = false;
  /// s: bound on the magnitude of an estimated time offset. While it is estimated, samples this close to the ends of
  /// the curve or to its gaps are left out.
  double largest_time_offset = 0.1;
};

}  // namespace splinertia
