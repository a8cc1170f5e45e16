// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia {

/// The exact motion for readings that stay constant from each sample to the next. Order 1 for point samples of readings
/// that change.
///   ΔR = exp(ω₀ h),  Δv = J(ω₀ h) f₀ h,  Δp = H(ω₀ h) f₀ h²
struct ZeroOrderHold : PointScheme<2> {
  template <typename Scalar, typename Window>
  [[nodiscard]] static StepMean<Scalar> moments(const Window& window, std::size_t from) {
    const Scalar h = step_interval<Scalar>(window, from);
    return {window[from].gyro * h, window[from].accel * h, h};
  }
};

}  // namespace splinertia
