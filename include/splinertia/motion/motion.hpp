// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/lie_group.hpp>

namespace splinertia {

namespace detail {

// One base class per derivative. The primary templates are empty: a derivative not asked for is not a member.
template <LieGroup G, bool exists>
struct MotionVelocity {};
template <LieGroup G>
struct MotionVelocity<G, true> {
  Tangent<G> velocity;  ///< ω with X⁻¹ dX/dt = ω^: body frame; per second
};

template <LieGroup G, bool exists>
struct MotionAcceleration {};
template <LieGroup G>
struct MotionAcceleration<G, true> {
  Tangent<G> acceleration;  ///< dω/dt; per second²
};

template <LieGroup G, bool exists>
struct MotionJerk {};
template <LieGroup G>
struct MotionJerk<G, true> {
  Tangent<G> jerk;  ///< d²ω/dt²; per second³
};

}  // namespace detail

/// The value of a curve X(t) on G at one time and its derivatives up to the D-th, D = 0 … 3. A derivative that was not
/// asked for does not exist: reading it is a compile error, not a zero.
template <LieGroup G, int D>
  requires(0 <= D && D <= 3)
struct Motion : detail::MotionVelocity<G, (D >= 1)>,
                detail::MotionAcceleration<G, (D >= 2)>,
                detail::MotionJerk<G, (D >= 3)> {
  using Group = G;
  G value;
};

}  // namespace splinertia
