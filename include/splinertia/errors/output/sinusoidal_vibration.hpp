// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>
#include <string_view>

namespace splinertia {

/// Vibration at one frequency: adds amplitude·sin(2π(frequency·t + phase)) to every sample, t since the first sample in
/// s. Amplitude in the sensor's unit, frequency in Hz, phase in turns. It does not count as bias. A frequency above
/// half the sampling rate is aliased, as in a sensor without an anti-aliasing filter.
template <typename Scalar = double, int N = 1>
struct SinusoidalVibration {
  static constexpr std::string_view name = "sinusoidal vibration";
  struct State {};

  PerAxis<Scalar, N> amplitude;
  PerAxis<Scalar, N> frequency;
  PerAxis<Scalar, N> phase;

  /// Throws std::invalid_argument unless amplitude and phase are finite and the frequency is finite and >= 0.
  constexpr SinusoidalVibration(const PerAxis<Scalar, N>& amplitude_, const PerAxis<Scalar, N>& frequency_,
                                const PerAxis<Scalar, N>& phase_ = Scalar(0))
      : amplitude(amplitude_), frequency(frequency_), phase(phase_) {
    detail::require_finite("SinusoidalVibration", "amplitude", amplitude);
    detail::require_non_negative("SinusoidalVibration", "frequency", frequency);
    detail::require_finite("SinusoidalVibration", "phase", phase);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    const AxisVector<Scalar, Axes> size = amplitude.template vector<Axes>(), rate = frequency.template vector<Axes>(),
                                   start = phase.template vector<Axes>();
    for (int i = 0; i < Axes; ++i) {
      const detail::Oscillation<Scalar> oscillation(rate[i] * sample.elapsed + start[i]);
      sample.value[i] += size[i] * oscillation.sine;
    }
  }

  void describe(auto&& parameter) const {
    parameter("amplitude", amplitude, SensorUnit{});
    parameter("frequency", frequency, "Hz");
    parameter("phase", phase, "turns");
  }
};

template <typename P, typename... More>
SinusoidalVibration(const P&, const More&...)
    -> SinusoidalVibration<detail::ScalarOfParameter<P>, detail::values_in_parameters<P, More...>>;

}  // namespace splinertia
