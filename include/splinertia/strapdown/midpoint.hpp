// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/nav_state.hpp>

namespace splinertia {

/// The mean of both ends of the step: attitude by the exact exponential of the mean rate, acceleration as the mean of
/// those at both ends, each with its own attitude. Order 2, the limit of any scheme that sees two neighbouring samples.
///   R₁ = R₀ exp((ω₀ + ω₁) h/2),  a = (R₀ f₀ + R₁ f₁)/2 + g,  v₁ = v₀ + a h,  p₁ = p₀ + v₀ h + a h²/2
/// Qin, Li, Shen, "VINS-Mono", IEEE TRO 2018, (7), with the exponential in place of a first-order quaternion.
struct Midpoint {
  template <typename Scalar, typename Time, typename Sample>
  [[nodiscard]] static NavState<Scalar, Time> step(const NavState<Scalar, Time>& state, const Sample& from,
                                                   const Sample& to, const Vector3<Scalar>& gravity) {
    const Scalar h = seconds<Scalar>(to.time - from.time);
    const Scalar half = Scalar(1) / Scalar(2);
    const auto R = advance_attitude<Scalar>(state.R_WB, (from.gyro + to.gyro) * (half * h));
    const Vector3<Scalar> f0 = rotate<Scalar>(state.R_WB.unit_quaternion(), from.accel);
    const Vector3<Scalar> a = half * (f0 + rotate<Scalar>(R.unit_quaternion(), to.accel)) + gravity;
    return {R, state.v_WB + a * h, state.p_WB + state.v_WB * h + a * (half * h * h), to.time};
  }
};

}  // namespace splinertia
