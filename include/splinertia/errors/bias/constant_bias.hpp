// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A bias that is the same in every sample of every run, in the sensor's unit. See turn_on_bias.hpp for one that is
/// drawn anew for every run.
template <typename Scalar = double, int N = 1>
struct ConstantBias {
  static constexpr std::string_view name = "constant bias";
  struct State {};

  PerAxis<Scalar, N> bias;

  /// Throws std::invalid_argument unless the bias is finite.
  constexpr ConstantBias(const PerAxis<Scalar, N>& bias_) : bias(bias_) {
    detail::require_finite("ConstantBias", "bias", bias);
  }

  template <int Axes>
  SPLINERTIA_ALWAYS_INLINE void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    sample.value += bias.template vector<Axes>();
    sample.bias += bias.template vector<Axes>();
  }

  void describe(auto&& parameter) const { parameter("bias", bias, SensorUnit{}); }
};

template <typename P>
ConstantBias(const P&) -> ConstantBias<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
