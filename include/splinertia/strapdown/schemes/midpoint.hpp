// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

/// The mean of the readings at both ends, constant over the step, and the exact motion for it. Order 2, which is the
/// highest for a scheme that uses two neighbouring samples.
///   φ = (ω₀ + ω₁) h/2,  ν = (f₀ + f₁) h/2,  ΔR = exp(φ),  Δv = J(φ) ν,  Δp = h H(φ) ν
struct Midpoint : PointScheme<2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static StepMean<Scalar> moments(const Window& window, std::size_t from) {
    const auto& first = window[from];
    const auto& second = window[from + 1];
    const Scalar h = step_interval<Scalar>(window, from);
    const Scalar half = h / Scalar(2);
    return {(first.gyro + second.gyro) * half, (first.accel + second.accel) * half, h};
  }
};

}  // namespace splinertia
