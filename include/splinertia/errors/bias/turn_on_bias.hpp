// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A bias that is drawn once for each run and then stays constant: normal, with the given standard deviation, in the
/// sensor's unit. Data sheets call it turn-on bias or bias repeatability.
template <typename Scalar = double, int N = 1>
struct TurnOnBias {
  static constexpr std::string_view name = "turn-on bias";
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : normal(Normals(term).template draw<Scalar>()) {}
    AxisVector<Scalar, Normals::axes> normal;
  };

  PerAxis<Scalar, N> standard_deviation;

  /// Throws std::invalid_argument unless the deviation is finite and >= 0.
  constexpr TurnOnBias(const PerAxis<Scalar, N>& standard_deviation_) : standard_deviation(standard_deviation_) {
    detail::require_non_negative("TurnOnBias", "standard deviation", standard_deviation);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    const AxisVector<Scalar, Axes> bias = standard_deviation.template vector<Axes>().cwiseProduct(state.normal);
    sample.value += bias;
    sample.bias += bias;
  }

  void describe(auto&& parameter) const { parameter("standard deviation", standard_deviation, SensorUnit{}); }
};

template <typename P>
TurnOnBias(const P&) -> TurnOnBias<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
