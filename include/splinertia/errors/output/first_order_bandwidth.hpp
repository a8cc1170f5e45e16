// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>
#include <string_view>

namespace splinertia {

/// A sensor of limited bandwidth: a first-order low pass, τy′ + y = x with τ = 1/(2π cutoff), −3 dB at the cutoff
/// frequency in Hz. It filters the reading with all terms before it in the model, the bias included. The discretisation
/// is exact for an input that is linear between samples (ramp invariant): slow motion is delayed by the true τ at any
/// sampling rate. It starts settled. Franklin, Powell, Workman, Digital Control of Dynamic Systems (1998), 6.3.
template <typename Scalar = double, int N = 1>
struct FirstOrderBandwidth {
  static constexpr std::string_view name = "first-order bandwidth";

  /// y ← y + gain·(x₀ − y) + ramp·(x₁ − x₀), from sample x₀ to sample x₁.
  struct Step {
    Scalar gain = Scalar(1), ramp = Scalar(0);
  };
  template <int Axes>
  struct State {
    AxisVector<Scalar, Axes> input, input_bias;
    AxisVector<Scalar, Axes> value, bias;
    detail::ForInterval<Scalar, detail::FixedArray<Step, Axes>> steps{};
  };

  PerAxis<Scalar, N> cutoff;

  /// Throws std::invalid_argument unless the cutoff is finite and > 0.
  constexpr FirstOrderBandwidth(const PerAxis<Scalar, N>& cutoff_) : cutoff(cutoff_) {
    detail::require_positive("FirstOrderBandwidth", "cutoff frequency", cutoff);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State<Axes>& state) const {
    if (sample.first) {
      state.value = sample.value;
      state.bias = sample.bias;
    } else {
      const auto& steps = state.steps(sample.interval, [&] { return make_steps<Axes>(sample.interval); });
      for (int i = 0; i < Axes; ++i) {
        const auto& [gain, ramp] = steps[static_cast<std::size_t>(i)];
        state.value[i] += gain * (state.input[i] - state.value[i]) + ramp * (sample.value[i] - state.input[i]);
        state.bias[i] += gain * (state.input_bias[i] - state.bias[i]) + ramp * (sample.bias[i] - state.input_bias[i]);
      }
    }
    state.input = sample.value;
    state.input_bias = sample.bias;
    sample.value = state.value;
    sample.bias = state.bias;
  }

  void describe(auto&& parameter) const { parameter("cutoff frequency", cutoff, "Hz"); }

 private:
  template <int Axes>
  [[nodiscard]] detail::FixedArray<Step, Axes> make_steps(const Scalar& interval) const {
    const AxisVector<Scalar, Axes> cutoffs = cutoff.template vector<Axes>();
    detail::FixedArray<Step, Axes> steps;
    for (int i = 0; i < Axes; ++i) {
      auto& [gain, ramp] = steps[static_cast<std::size_t>(i)];
      const Scalar h = Scalar(2) * detail::pi_of<Scalar>() * cutoffs[i] * interval;  // in units of τ
      gain = detail::one_minus_exp_minus<Scalar>(h);
      ramp = h > Scalar(0) ? Scalar(Scalar(1) - gain / h) : Scalar(0);
    }
    return steps;
  }
};

template <typename P>
FirstOrderBandwidth(const P&) -> FirstOrderBandwidth<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
