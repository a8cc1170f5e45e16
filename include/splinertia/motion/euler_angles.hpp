// SPDX-License-Identifier: MIT
/// Attitude as yaw, pitch and roll: R_WB = R_z(ψ) R_y(θ) R_x(φ), the aerospace sequence 3-2-1.
#pragma once

#include <cmath>
#include <splinertia/group/detail/rotation.hpp>

namespace splinertia {

/// An angle and its first two derivatives: rad, rad/s, rad/s².
template <typename Scalar>
struct AngleMotion {
  Scalar angle = Scalar(0);
  Scalar rate = Scalar(0);
  Scalar acceleration = Scalar(0);
};

/// Yaw ψ, pitch θ and roll φ with their derivatives, and the attitude that follows from them.
template <typename Scalar>
struct EulerAngles {
  AngleMotion<Scalar> yaw, pitch, roll;

  /// The unit quaternion of R_WB.
  [[nodiscard]] Eigen::Quaternion<Scalar> quaternion() const {
    using std::cos, std::sin;
    const Scalar half = Scalar(1) / Scalar(2);
    const Scalar sy = sin(half * yaw.angle), cy = cos(half * yaw.angle);
    const Scalar sp = sin(half * pitch.angle), cp = cos(half * pitch.angle);
    const Scalar sr = sin(half * roll.angle), cr = cos(half * roll.angle);
    return {cy * cp * cr + sy * sp * sr, cy * cp * sr - sy * sp * cr, cy * sp * cr + sy * cp * sr,
            sy * cp * cr - cy * sp * sr};
  }

  /// ω in the body, rad/s. Diebel, "Representing Attitude" (2006), (287) with (292).
  [[nodiscard]] Eigen::Vector3<Scalar> angular_velocity() const {
    using std::cos, std::sin;
    const Scalar sp = sin(pitch.angle), cp = cos(pitch.angle);
    const Scalar sr = sin(roll.angle), cr = cos(roll.angle);
    return {roll.rate - yaw.rate * sp,  //
            pitch.rate * cr + yaw.rate * cp * sr, yaw.rate * cp * cr - pitch.rate * sr};
  }

  /// α = dω/dt, rad/s².
  [[nodiscard]] Eigen::Vector3<Scalar> angular_acceleration() const {
    using std::cos, std::sin;
    const Scalar sp = sin(pitch.angle), cp = cos(pitch.angle);
    const Scalar sr = sin(roll.angle), cr = cos(roll.angle);
    const Scalar forward = yaw.acceleration * cp - yaw.rate * pitch.rate * sp;  // d/dt of ψ̇ cos θ
    return {roll.acceleration - yaw.acceleration * sp - yaw.rate * pitch.rate * cp,
            (pitch.acceleration + yaw.rate * roll.rate * cp) * cr + (forward - pitch.rate * roll.rate) * sr,
            (forward - pitch.rate * roll.rate) * cr - (pitch.acceleration + yaw.rate * roll.rate * cp) * sr};
  }
};

}  // namespace splinertia
