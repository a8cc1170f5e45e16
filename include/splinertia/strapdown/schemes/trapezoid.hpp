// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/detail/linearized_increment.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

/// The mean of the accelerations at both ends, each turned by its own attitude. VINS-Mono calls this midpoint. Order 2.
///   ΔR = exp((ω₀ + ω₁) h/2),  Δv = (f₀ + ΔR f₁) h/2,  Δp = Δv h/2
/// Qin, Li, Shen, "VINS-Mono", IEEE TRO 34 (2018), (7), with the exponential instead of a first-order quaternion.
struct Trapezoid : PointScheme<2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::NavIncrement<Scalar> increment(const Window& window, std::size_t from) {
    const auto& first = window[from];
    const auto& second = window[from + 1];
    const Scalar h = step_interval<Scalar>(window, from);
    const Scalar half = h / Scalar(2);
    const auto rotation = detail::rotation_exp<Scalar>((first.gyro + second.gyro) * half);
    const Eigen::Vector3<Scalar> velocity = (first.accel + detail::rotate<Scalar>(rotation, second.accel)) * half;
    return {rotation, velocity, velocity * half, h};
  }

  template <typename Scalar, typename Window>
  [[nodiscard]] static detail::LinearizedIncrement<Scalar> linearize(const Window& window, std::size_t from) {
    detail::LinearizedIncrement<Scalar> result;
    result.value = increment<Scalar>(window, from);
    const Scalar h = result.value.interval, half = h / Scalar(2);
    const Eigen::Vector3<Scalar> phi = (window[from].gyro + window[from + 1].gyro) * half;
    const Eigen::Matrix3<Scalar> R = result.value.rotation.toRotationMatrix();
    result.R_w = h * detail::rotation_left_jacobian<Scalar>(-phi);
    result.v_w = -half * R * detail::hat<Scalar>(window[from + 1].accel) * result.R_w;
    result.v_f = half * (Eigen::Matrix3<Scalar>::Identity() + R);
    result.p_w = half * result.v_w;
    result.p_f = half * result.v_f;
    return result;
  }
};

}  // namespace splinertia
