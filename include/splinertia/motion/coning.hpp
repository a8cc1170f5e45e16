// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <splinertia/motion/split_motion.hpp>

namespace splinertia {

/// Classical coning about the z axis, at the origin: the body's z axis moves on a cone of half-angle a, period 2π/Ω,
///
///   q = (sin(a/2) cos Ωt, sin(a/2) sin Ωt, 0; cos(a/2)).
///
/// This is the hardest motion for an attitude integrator. Bortz, "A New Mathematical Formulation for Strapdown Inertial
/// Navigation", IEEE TAES 1971; Savage, "Strapdown Inertial Navigation Integration Algorithm Design Part 1", JGCD 1998.
template <typename Real = double>
struct Coning {
  using Scalar = Real;
  using Group = SO3xR3<Scalar>;
  using Time = Scalar;

  Scalar angle = Scalar(1) / Scalar(10);  ///< a, rad
  Scalar rate = Scalar(1);                ///< Ω, rad/s

  [[nodiscard]] Time start() const { return -std::numeric_limits<Scalar>::infinity(); }
  [[nodiscard]] Time end() const { return std::numeric_limits<Scalar>::infinity(); }

  /// t in s. Requires a finite t.
  template <int D>
    requires(D <= 2)
  [[nodiscard]] Motion<Group, D> evaluate(Time t) const {
    using std::cos, std::sin;
    const Scalar c = cos(rate * t), s = sin(rate * t), zero(0);
    const Scalar half_sin = sin(angle / Scalar(2)), half_cos = cos(angle / Scalar(2));
    const Scalar sin_angle = sin(angle);
    RigidBodyState<Scalar> state;
    state.q_WB = Eigen::Quaternion<Scalar>(half_cos, half_sin * c, half_sin * s, zero);
    state.p_WB.setZero();
    // 1 − cos a = 2 sin²(a/2), without cancellation
    state.omega << -rate * sin_angle * s, rate * sin_angle * c, -Scalar(2) * rate * half_sin * half_sin;
    state.v_WB.setZero();
    state.alpha << -rate * rate * sin_angle * c, -rate * rate * sin_angle * s, zero;
    state.a_WB.setZero();
    return split_motion<D>(state);
  }
};

}  // namespace splinertia
