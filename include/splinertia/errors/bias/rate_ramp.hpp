// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A bias that grows linearly with time, from zero at the first sample: bias = R·t. R in the sensor's unit per s:
/// rad/s² for a gyroscope, m/s³ for an accelerometer. Allan deviation R·τ/√2. IEEE Std 952-1997, C.1.4.
template <typename Scalar = double, int N = 1>
struct RateRamp {
  static constexpr std::string_view name = "rate ramp";
  struct State {};

  PerAxis<Scalar, N> slope;

  /// Throws std::invalid_argument unless the slope is finite.
  constexpr RateRamp(const PerAxis<Scalar, N>& slope_) : slope(slope_) {
    detail::require_finite("RateRamp", "slope", slope);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    const AxisVector<Scalar, Axes> bias = slope.template vector<Axes>() * sample.elapsed;
    sample.value += bias;
    sample.bias += bias;
  }

  void describe(auto&& parameter) const { parameter("slope", slope, SensorUnit{1}); }
};

template <typename P>
RateRamp(const P&) -> RateRamp<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
