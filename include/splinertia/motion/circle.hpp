// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <splinertia/motion/euler_angles.hpp>
#include <splinertia/motion/split_motion.hpp>

namespace splinertia {

/// A level circle at constant speed, heading along the tangent:
///   p = (r cos Ωt, r sin Ωt, h),  yaw = Ωt + π/2,  pitch = roll = 0.
template <typename Real = double>
struct Circle {
  using Scalar = Real;
  using Group = SO3xR3<Scalar>;
  using Time = Scalar;

  Scalar radius = Scalar(1);  ///< r, m
  Scalar rate = Scalar(1);    ///< Ω, rad/s; positive is counter-clockwise seen from above
  Scalar height = Scalar(0);  ///< h, m

  [[nodiscard]] Time start() const { return -std::numeric_limits<Scalar>::infinity(); }
  [[nodiscard]] Time end() const { return std::numeric_limits<Scalar>::infinity(); }

  /// t in s. Requires a finite t.
  template <int D>
    requires(D <= 2)
  [[nodiscard]] Motion<Group, D> evaluate(Time t) const {
    using std::acos, std::cos, std::sin;
    const Scalar c = cos(rate * t), s = sin(rate * t), zero(0);
    EulerAngles<Scalar> attitude;
    attitude.yaw = {rate * t + acos(zero), rate, zero};  // acos(0) = π/2 in any scalar
    RigidBodyState<Scalar> state;
    state.q_WB = attitude.quaternion();
    state.p_WB << radius * c, radius * s, height;
    state.omega << zero, zero, rate;
    state.v_WB << -radius * rate * s, radius * rate * c, zero;
    state.alpha.setZero();
    state.a_WB << -radius * rate * rate * c, -radius * rate * rate * s, zero;
    return split_motion<D>(state);
  }
};

}  // namespace splinertia
