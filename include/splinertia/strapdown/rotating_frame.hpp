// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/nav_state.hpp>

namespace splinertia {

/// A rotating world such as the Earth: the Frame of an integration with the world's rotation and the Coriolis
/// acceleration,
///
///   Rᵀ R' = ω − Rᵀ Ω,  v' = R f + g − 2 Ω × v,  p' = v
///
/// where gravity g includes the centrifugal acceleration, as a plumb line shows it. In each step the rotation of the
/// world enters the attitude exactly, and velocity and position to first order in |Ω| h for any motion of the body. The
/// overall method is second-order accurate. Groves, Principles of GNSS, Inertial, and Multisensor Integrated Navigation
/// Systems (2013), 5.3 to 5.5.
template <typename Scalar>
struct RotatingFrame {
  /// Ω: angular velocity of the world relative to inertial space, in the world, rad/s. Earth: 7.292115e-5 about its
  /// axis.
  Eigen::Vector3<Scalar> rate;

  template <typename Time>
  [[nodiscard]] NavState<Scalar, Time> advance(const NavState<Scalar, Time>& state,
                                               const detail::NavIncrement<Scalar>& increment,
                                               const Eigen::Vector3<Scalar>& gravity, Time time) const {
    const auto& q = state.R_WB.unit_quaternion();
    const Scalar h = increment.interval;
    const Eigen::Vector3<Scalar> fall = gravity * h;
    const Eigen::Vector3<Scalar> dv = detail::rotate<Scalar>(q, increment.velocity),
                                 dp = detail::rotate<Scalar>(q, increment.position);
    // The force turns back by Ω t, which contributes −Ω × ∫ t f dt, ∫ t f dt = h Δv − Δp, to the velocity and
    // −Ω × ∫ (h − t) t f dt to the position. The Coriolis acceleration contributes −2 Ω × (p₁ − p₀) to the velocity. In
    // the position both add up to −h Ω × (Δp + (v₀ + g h/3) h).
    const Eigen::Vector3<Scalar> inertial = (state.v_WB + fall / Scalar(2)) * h + dp;
    const Eigen::Vector3<Scalar> moved = inertial - rate.cross((inertial - fall * (h / Scalar(6))) * h);
    const Eigen::Vector3<Scalar> v = state.v_WB + fall + dv - rate.cross(dv * h - dp + moved * Scalar(2));
    const Eigen::Quaternion<Scalar> back = detail::rotation_exp<Scalar>(-rate * h);
    return {detail::advance_attitude<Scalar>(back,
                                             detail::advance_attitude<Scalar>(q, increment.rotation).unit_quaternion()),
            v, state.p_WB + moved, time};
  }
};

template <typename Derived>
RotatingFrame(const Eigen::MatrixBase<Derived>&) -> RotatingFrame<typename Derived::Scalar>;

}  // namespace splinertia
