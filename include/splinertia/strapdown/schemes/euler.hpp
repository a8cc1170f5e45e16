// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/detail/linearized_increment.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

/// The explicit Euler method: rate and force keep their values at the beginning of the step, and the force does not
/// turn with the body. Order 1; a baseline that every other scheme should beat.
///   ΔR = exp(ω₀ h),  Δv = f₀ h,  Δp = f₀ h²/2
struct Euler : PointScheme<2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    const auto& sample = window[from];
    const Scalar h = step_interval<Scalar>(window, from);
    const Eigen::Vector3<Scalar> velocity = sample.accel * h;
    return {detail::rotation_exp<Scalar>(sample.gyro * h), velocity, velocity * (h / Scalar(2)), h};
  }

  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::LinearizedIncrement<Scalar> linearize(const Window& window, std::size_t from) {
    detail::LinearizedIncrement<Scalar> result;
    result.value = increment<Scalar>(window, from);
    const Scalar h = result.value.interval;
    result.R_w = h * detail::rotation_left_jacobian<Scalar>(window[from].gyro * -h);
    result.v_w.setZero();
    result.v_f = h * Eigen::Matrix3<Scalar>::Identity();
    result.p_w.setZero();
    result.p_f = (h * h / Scalar(2)) * Eigen::Matrix3<Scalar>::Identity();
    return result;
  }
};

}  // namespace splinertia
