// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <splinertia/motion/motion.hpp>
#include <splinertia/motion/trajectory.hpp>

namespace splinertia {

/// X(t) = X₀ exp(t ω): constant velocity on any group, for all times. On SE(3) this is a screw motion; on SO(3) × R³ a
/// constant body rate and a constant world velocity. A zero twist is a body at rest.
template <LieGroup G>
struct ConstantTwist {
  using Group = G;
  using Scalar = ScalarOf<G>;
  using Time = Scalar;

  G initial = GroupTraits<G>::identity();  ///< X₀, the value at t = 0
  Tangent<G> twist = Tangent<G>::Zero();   ///< body frame, per second

  [[nodiscard]] Time start() const { return -std::numeric_limits<Scalar>::infinity(); }
  [[nodiscard]] Time end() const { return std::numeric_limits<Scalar>::infinity(); }

  /// Requires a finite t.
  template <int D>
  [[nodiscard]] Motion<G, D> evaluate(Time t) const {
    Motion<G, D> m;
    m.value = GroupTraits<G>::compose(initial, GroupTraits<G>::exp(t * twist));
    if constexpr (D >= 1) m.velocity = twist;
    if constexpr (D >= 2) m.acceleration.setZero();
    if constexpr (D >= 3) m.jerk.setZero();
    return m;
  }
};

/// A body at rest at `pose`, as in the static logs of Allan analysis.
template <LieGroup G>
[[nodiscard]] ConstantTwist<G> at_rest(const G& pose) {
  return {pose, Tangent<G>::Zero()};
}

}  // namespace splinertia
