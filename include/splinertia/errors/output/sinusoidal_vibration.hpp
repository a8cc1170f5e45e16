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
template <typename Scalar = double>
struct SinusoidalVibration {
  static constexpr std::string_view name = "sinusoidal vibration";
  struct State {};

  PerAxis<Scalar> amplitude;
  PerAxis<Scalar> frequency;
  PerAxis<Scalar> phase;

  /// Throws std::invalid_argument unless amplitude and phase are finite and the frequency is finite and >= 0.
  constexpr SinusoidalVibration(const PerAxis<Scalar>& amplitude_, const PerAxis<Scalar>& frequency_,
                                const PerAxis<Scalar>& phase_ = Scalar(0))
      : amplitude(amplitude_), frequency(frequency_), phase(phase_) {
    require_finite("SinusoidalVibration", "amplitude", amplitude);
    require_non_negative("SinusoidalVibration", "frequency", frequency);
    require_finite("SinusoidalVibration", "phase", phase);
  }

  void apply(Sample<Scalar>& sample, State&) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Oscillation<Scalar> oscillation(frequency[axis] * sample.elapsed + phase[axis]);
      sample.value[static_cast<int>(axis)] += amplitude[axis] * oscillation.sine;
    }
  }

  void describe(auto&& parameter) const {
    parameter("amplitude", amplitude, SensorUnit{});
    parameter("frequency", frequency, "Hz");
    parameter("phase", phase, "turns");
  }
};

template <typename P, typename... More>
SinusoidalVibration(const P&, const More&...) -> SinusoidalVibration<ScalarOfParameter<P>>;

}  // namespace splinertia
