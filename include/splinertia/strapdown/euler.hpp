// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/nav_state.hpp>

namespace splinertia {

/// The explicit Euler method: everything stays over the step as it was at its beginning. Order 1; the reference that
/// every other scheme should beat.
///   R₁ = R₀ exp(ω₀ h),  a = R₀ f₀ + g,  v₁ = v₀ + a h,  p₁ = p₀ + v₀ h + a h²/2
struct Euler {
  template <typename Scalar, typename Time, typename Sample>
  [[nodiscard]] static NavState<Scalar, Time> step(const NavState<Scalar, Time>& state, const Sample& from,
                                                   const Sample& to, const Vector3<Scalar>& gravity) {
    const Scalar h = seconds<Scalar>(to.time - from.time);
    const auto& q = state.R_WB.unit_quaternion();
    const Vector3<Scalar> a = rotate<Scalar>(q, from.accel) + gravity;
    return {advance_attitude<Scalar>(state.R_WB, from.gyro * h), state.v_WB + a * h,
            state.p_WB + state.v_WB * h + a * (h * h / Scalar(2)), to.time};
  }
};

}  // namespace splinertia
