// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <splinertia/motion/euler_angles.hpp>
#include <splinertia/motion/split_motion.hpp>

namespace splinertia::testing {

/// A body thrown about, smooth but hard to integrate: from 0 to 10 s up to 20.74 rad/s and 128.9 m/s² (t in s),
///   yaw = 2.04 sin 3.3t, pitch = 0.96 sin(7.8t + 1), roll = 1.92 sin(7.8t + 2) rad
///   p = (1.22 sin 7.9t, 1.02 sin(9.7t + 1), 0.82 sin(7t + 2)) m.
template <typename Real = double>
struct AggressiveMotion {
  using Scalar = Real;
  using Group = SO3xR3<Scalar>;
  using Time = Scalar;

  Scalar speed = Scalar(1);  ///< less makes it gentler: t is speed times as much

  [[nodiscard]] Time start() const { return -std::numeric_limits<Scalar>::infinity(); }
  [[nodiscard]] Time end() const { return std::numeric_limits<Scalar>::infinity(); }

  /// Requires a finite t, s.
  template <int D>
    requires(D <= 2)
  [[nodiscard]] Motion<Group, D> evaluate(Time t) const {
    const auto sine = [&](double amplitude, double frequency, double phase) -> AngleMotion<Scalar> {
      using std::cos, std::sin;
      const Scalar a = static_cast<Scalar>(amplitude), w = speed * static_cast<Scalar>(frequency);
      const Scalar angle = w * t + static_cast<Scalar>(phase);
      return {a * sin(angle), a * w * cos(angle), -a * w * w * sin(angle)};
    };
    const EulerAngles<Scalar> attitude{sine(2.04, 3.3, 0), sine(0.96, 7.8, 1), sine(1.92, 7.8, 2)};
    const auto x = sine(1.22, 7.9, 0), y = sine(1.02, 9.7, 1), z = sine(0.82, 7, 2);
    RigidBodyState<Scalar> state;
    state.q_WB = attitude.quaternion();
    state.p_WB << x.angle, y.angle, z.angle;
    state.omega = attitude.angular_velocity();
    state.v_WB << x.rate, y.rate, z.rate;
    state.alpha = attitude.angular_acceleration();
    state.a_WB << x.acceleration, y.acceleration, z.acceleration;
    return split_motion<D>(state);
  }
};

}  // namespace splinertia::testing
