// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/nav_state.hpp>

namespace splinertia {

/// A world that turns, as the Earth does: the Frame of an integration that minds its rotation and the Coriolis
/// acceleration,
///
///   Rᵀ R' = ω − Rᵀ Ω,  v' = R f + g − 2 Ω × v,  p' = v
///
/// with gravity g that includes the centrifugal acceleration, as plumb lines do. Groves, Principles of GNSS, Inertial,
/// and Multisensor Integrated Navigation Systems (2013), 5.3 to 5.5. Attitude is exact, velocity and position to first
/// order in |Ω| h whatever the body does in a step; of second order it is in the whole.
template <typename Scalar>
struct RotatingFrame {
  /// Ω of the world against inertial space, in the world, rad/s; the Earth: 7.292115e-5 about its axis.
  Vector3<Scalar> rate;

  template <typename Time>
  [[nodiscard]] NavState<Scalar, Time> advance(const NavState<Scalar, Time>& state,
                                               const NavIncrement<Scalar>& increment, const Vector3<Scalar>& gravity,
                                               Time time) const {
    const auto& q = state.R_WB.unit_quaternion();
    const Scalar h = increment.interval;
    const Vector3<Scalar> fall = gravity * h;
    const Vector3<Scalar> dv = rotate<Scalar>(q, increment.velocity), dp = rotate<Scalar>(q, increment.position);
    // The force turns back by Ω t: ∫ t f dt = h Δv − Δp and ∫ (h − t) t f dt are left of it. The Coriolis acceleration
    // takes −2 Ω × the way that was moved from the velocity. In position both add up to h Δp and the inertial way.
    const Vector3<Scalar> inertial = (state.v_WB + fall / Scalar(2)) * h + dp;
    const Vector3<Scalar> moved = inertial - rate.cross((inertial - fall * (h / Scalar(6))) * h);
    const Vector3<Scalar> v = state.v_WB + fall + dv - rate.cross(dv * h - dp + moved * Scalar(2));
    const Eigen::Quaternion<Scalar> back = rotation_exp<Scalar>(-rate * h);
    return {advance_attitude<Scalar>(back, advance_attitude<Scalar>(q, increment.rotation).unit_quaternion()), v,
            state.p_WB + moved, time};
  }
};

template <typename Derived>
RotatingFrame(const Eigen::MatrixBase<Derived>&) -> RotatingFrame<typename Derived::Scalar>;

}  // namespace splinertia
