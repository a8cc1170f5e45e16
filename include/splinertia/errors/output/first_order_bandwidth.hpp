// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>
#include <string_view>

namespace splinertia {

/// A sensor of limited bandwidth: a first-order low pass, τy′ + y = x with τ = 1/(2π cutoff), −3 dB at the cutoff
/// frequency in Hz. It filters the reading with all terms before it in the model, the bias included. The discretisation
/// is exact for an input that is linear between samples (ramp invariant): slow motion is delayed by the true τ at any
/// sampling rate. It starts settled. Franklin, Powell, Workman, Digital Control of Dynamic Systems (1998), 6.3.
template <typename Scalar = double>
struct FirstOrderBandwidth {
  static constexpr std::string_view name = "first-order bandwidth";

  /// y ← y + forget·(x₀ − y) + ramp·(x₁ − x₀), from sample x₀ to sample x₁.
  struct Step {
    Scalar forget = Scalar(1), ramp = Scalar(0);
  };
  struct State {
    Vector3<Scalar> input, input_bias;
    Vector3<Scalar> value, bias;
    ForInterval<Scalar, std::array<Step, 3>> steps{};
  };

  PerAxis<Scalar> cutoff;

  /// Throws std::invalid_argument unless the cutoff is finite and > 0.
  constexpr FirstOrderBandwidth(const PerAxis<Scalar>& cutoff_) : cutoff(cutoff_) {
    require_positive("FirstOrderBandwidth", "cutoff frequency", cutoff);
  }

  void apply(Sample<Scalar>& sample, State& state) const {
    if (sample.first) {
      state.value = sample.value;
      state.bias = sample.bias;
    } else {
      const auto& steps = state.steps(sample.interval, [&] { return make_steps(sample.interval); });
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<int>(axis);
        const auto& [forget, ramp] = steps[axis];
        state.value[i] += forget * (state.input[i] - state.value[i]) + ramp * (sample.value[i] - state.input[i]);
        state.bias[i] += forget * (state.input_bias[i] - state.bias[i]) + ramp * (sample.bias[i] - state.input_bias[i]);
      }
    }
    state.input = sample.value;
    state.input_bias = sample.bias;
    sample.value = state.value;
    sample.bias = state.bias;
  }

  void describe(auto&& parameter) const { parameter("cutoff frequency", cutoff, "Hz"); }

 private:
  [[nodiscard]] std::array<Step, 3> make_steps(const Scalar& interval) const {
    std::array<Step, 3> steps;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Scalar h = Scalar(2) * pi_of<Scalar>() * cutoff[axis] * interval;  // in units of τ
      steps[axis].forget = exponential_rise<Scalar>(h);
      steps[axis].ramp = h > Scalar(0) ? Scalar(Scalar(1) - steps[axis].forget / h) : Scalar(0);
    }
    return steps;
  }
};

template <typename P>
FirstOrderBandwidth(const P&) -> FirstOrderBandwidth<ScalarOfParameter<P>>;

}  // namespace splinertia
