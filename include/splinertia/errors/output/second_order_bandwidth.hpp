// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/errors/detail/second_order_response.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A sensor that responds as a damped oscillator (a proof mass on a spring, a second-order filter):
/// y″ + 2ζω y′ + ω² y = ω² x with ω = 2π natural_frequency (Hz). It filters the reading with all terms before it in the
/// model, the bias included. ζ = 1/√2 is a Butterworth filter, −3 dB at the natural frequency. The discretisation is
/// exact for an input that is linear between samples (ramp invariant). It starts settled.
template <typename Scalar = double, int N = 1>
struct SecondOrderBandwidth {
  static constexpr std::string_view name = "second-order bandwidth";

  /// (y, y′/ω) ← (x₀, 0) + transition·(y − x₀, y′/ω) + ramp·(x₁ − x₀), from sample x₀ to sample x₁.
  struct Step {
    Eigen::Matrix<Scalar, 2, 2> transition;
    Eigen::Matrix<Scalar, 2, 1> ramp;
  };
  template <int Axes>
  struct Signal {
    AxisVector<Scalar, Axes> input, output, rate;  // rate: y′/ω
  };
  template <int Axes>
  struct State {
    Signal<Axes> value, bias;
    detail::ForInterval<Scalar, detail::FixedArray<Step, Axes>> steps{};
  };

  PerAxis<Scalar, N> natural_frequency;
  PerAxis<Scalar, N> damping_ratio;

  /// Throws std::invalid_argument unless both are finite and > 0, and the third power of the damping ratio finite.
  constexpr SecondOrderBandwidth(const PerAxis<Scalar, N>& natural_frequency_, const PerAxis<Scalar, N>& damping_ratio_)
      : natural_frequency(natural_frequency_), damping_ratio(damping_ratio_) {
    detail::require_positive("SecondOrderBandwidth", "natural frequency", natural_frequency);
    detail::require_positive("SecondOrderBandwidth", "damping ratio", damping_ratio);
    detail::require_factor("SecondOrderBandwidth", "damping ratio", damping_ratio);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State<Axes>& state) const {
    if (sample.first) {
      state.value = {sample.value, sample.value, AxisVector<Scalar, Axes>::Zero()};
      state.bias = {sample.bias, sample.bias, AxisVector<Scalar, Axes>::Zero()};
      return;
    }
    const auto& steps = state.steps(sample.interval, [&] { return make_steps<Axes>(sample.interval); });
    advance(state.value, sample.value, steps);
    advance(state.bias, sample.bias, steps);
  }

  void describe(auto&& parameter) const {
    parameter("natural frequency", natural_frequency, "Hz");
    parameter("damping ratio", damping_ratio, "1");
  }

 private:
  template <int Axes>
  static void advance(Signal<Axes>& signal, AxisVector<Scalar, Axes>& value,
                      const detail::FixedArray<Step, Axes>& steps) {
    for (int i = 0; i < Axes; ++i) {
      const auto& [transition, ramp] = steps[static_cast<std::size_t>(i)];
      const Scalar before = signal.input[i], change = value[i] - before;
      const Scalar off = signal.output[i] - before, rate = signal.rate[i];
      signal.output[i] = before + transition(0, 0) * off + transition(0, 1) * rate + ramp[0] * change;
      signal.rate[i] = transition(1, 0) * off + transition(1, 1) * rate + ramp[1] * change;
    }
    signal.input = value;
    value = signal.output;
  }

  template <int Axes>
  [[nodiscard]] detail::FixedArray<Step, Axes> make_steps(const Scalar& interval) const {
    const AxisVector<Scalar, Axes> frequency = natural_frequency.template vector<Axes>(),
                                   damping = damping_ratio.template vector<Axes>();
    detail::FixedArray<Step, Axes> steps;
    for (int i = 0; i < Axes; ++i) {
      steps[static_cast<std::size_t>(i)] =
          make_step(Scalar(2) * detail::pi_of<Scalar>() * frequency[i] * interval, damping[i]);
    }
    return steps;
  }

  // a = ωh. With x = x₀ + s·t, y = x − 2ζs/ω, y′ = s is a solution; the deviation from it follows the transition alone.
  [[nodiscard]] static Step make_step(const Scalar& a, const Scalar& damping) {
    using Matrix = Eigen::Matrix<Scalar, 2, 2>;
    using Vector = Eigen::Matrix<Scalar, 2, 1>;
    if (!detail::is_finite(a)) return {Matrix::Zero(), Vector(Scalar(1), Scalar(0))};              // follows at once
    if (!(a > (std::numeric_limits<Scalar>::min)())) return {Matrix::Identity(), Vector::Zero()};  // never moves
    const Scalar step_response = detail::oscillator_step_response<Scalar>(a, damping);
    const Matrix transition = detail::oscillator_transition<Scalar>(a, damping);
    const Scalar ramp = Scalar(1) - (Scalar(2) * damping * step_response + transition(0, 1)) / a;
    return {transition, Vector(ramp, step_response / a)};
  }
};

template <typename P, typename... More>
SecondOrderBandwidth(const P&, const More&...)
    -> SecondOrderBandwidth<detail::ScalarOfParameter<P>, detail::values_in_parameters<P, More...>>;

}  // namespace splinertia
