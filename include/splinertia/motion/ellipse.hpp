// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <splinertia/motion/euler_angles.hpp>
#include <splinertia/motion/split_motion.hpp>

namespace splinertia {

/// An ellipse with a vertical wave, as in the simulators of VIO courses. One revolution takes 2π/K (20 s):
///   p = (15 cos Kt + 5, 20 sin Kt + 5, sin 10Kt + 5) m
///   roll = 0.1 cos t, pitch = 0.2 sin t, yaw = Kt rad.
template <typename Real = double>
struct Ellipse {
  using Scalar = Real;
  using Group = SO3xR3<Scalar>;
  using Time = Scalar;

  Scalar rate = default_rate();  ///< K, rad/s

  [[nodiscard]] Time start() const { return -std::numeric_limits<Scalar>::infinity(); }
  [[nodiscard]] Time end() const { return std::numeric_limits<Scalar>::infinity(); }

  /// t in s. Requires a finite t.
  template <int D>
    requires(D <= 2)
  [[nodiscard]] Motion<Group, D> evaluate(Time t) const {
    using std::cos, std::sin;
    const Scalar K = rate, zero(0);
    const Scalar a(15), b(20), centre(5), waves(10);
    const Scalar roll_amplitude = Scalar(1) / Scalar(10), pitch_amplitude = Scalar(1) / Scalar(5);
    const Scalar c = cos(K * t), s = sin(K * t);
    const Scalar c_wave = cos(waves * K * t), s_wave = sin(waves * K * t);
    EulerAngles<Scalar> attitude;
    attitude.yaw = {K * t, K, zero};
    attitude.pitch = {pitch_amplitude * sin(t), pitch_amplitude * cos(t), -pitch_amplitude * sin(t)};
    attitude.roll = {roll_amplitude * cos(t), -roll_amplitude * sin(t), -roll_amplitude * cos(t)};
    RigidBodyState<Scalar> state;
    state.q_WB = attitude.quaternion();
    state.p_WB << a * c + centre, b * s + centre, s_wave + centre;
    state.omega = attitude.angular_velocity();
    state.v_WB << -a * K * s, b * K * c, waves * K * c_wave;
    state.alpha = attitude.angular_acceleration();
    state.a_WB << -a * K * K * c, -b * K * K * s, -waves * waves * K * K * s_wave;
    return split_motion<D>(state);
  }

 private:
  static Scalar default_rate() {
    using std::acos;
    return acos(Scalar(0)) / Scalar(5);  // π/10
  }
};

}  // namespace splinertia
