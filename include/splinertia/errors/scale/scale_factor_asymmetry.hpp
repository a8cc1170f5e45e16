// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A scale factor that differs between positive and negative input: x becomes x + asymmetry/2·|x|, and the bias in it is
/// multiplied by the same slope, 1 ± asymmetry/2. The asymmetry is the difference of the two scale factors as a fraction
/// of their mean. IEEE Std 528 (inertial sensor terminology), "scale-factor asymmetry".
template <typename Scalar = double, int N = 1>
struct ScaleFactorAsymmetry {
  static constexpr std::string_view name = "scale factor asymmetry";
  struct State {};

  PerAxis<Scalar, N> asymmetry;

  /// Throws std::invalid_argument unless the asymmetry is > −2 and < 2: beyond, one of the slopes would not be positive.
  constexpr ScaleFactorAsymmetry(const PerAxis<Scalar, N>& asymmetry_) : asymmetry(asymmetry_) {
    for (const Scalar& a : asymmetry)
      detail::require(a > Scalar(-2) && a < Scalar(2), "ScaleFactorAsymmetry", "asymmetry", a, "a number > -2 and < 2");
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    const AxisVector<Scalar, Axes> half = asymmetry.template vector<Axes>() / Scalar(2);
    for (int i = 0; i < Axes; ++i) {
      const Scalar error = sample.value[i] < Scalar(0) ? Scalar(-half[i]) : half[i];
      sample.value[i] += error * sample.value[i];
      sample.bias[i] += error * sample.bias[i];
    }
  }

  void describe(auto&& parameter) const { parameter("asymmetry", asymmetry, "1"); }
};

template <typename P>
ScaleFactorAsymmetry(const P&) -> ScaleFactorAsymmetry<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
