// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Spikes (outliers): in each axis, each sample independently has an additional normal error of the given standard
/// deviation, in the sensor's unit, with the given probability. With white noise before it, this is the contaminated
/// normal distribution of Huber, "Robust Estimation of a Location Parameter", Ann. Math. Stat. 35 (1964). It does not
/// count as bias. With a higher probability, the spikes of a lower one remain.
template <typename Scalar = double, int N = 1>
struct Spikes {
  static constexpr std::string_view name = "spikes";
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : when(term / "when"), size(term / "size") {}
    Normals when, size;
  };

  PerAxis<Scalar, N> probability;
  PerAxis<Scalar, N> standard_deviation;

  /// Throws std::invalid_argument unless 0 <= probability <= 1 and the deviation is finite and >= 0.
  constexpr Spikes(const PerAxis<Scalar, N>& probability_, const PerAxis<Scalar, N>& standard_deviation_)
      : probability(probability_), standard_deviation(standard_deviation_) {
    for (const Scalar& p : probability)
      detail::require(p >= Scalar(0) && p <= Scalar(1), "Spikes", "probability", p, "a number >= 0 and <= 1");
    detail::require_non_negative("Spikes", "standard deviation", standard_deviation);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    const AxisVector<double, Axes> when = state.when.draw_uniform();
    const AxisVector<Scalar, Axes> size =
        standard_deviation.template vector<Axes>().cwiseProduct(state.size.template draw<Scalar>());
    for (int i = 0; i < Axes; ++i) {
      if (when[i] < probability[static_cast<std::size_t>(i)]) sample.value[i] += size[i];
    }
  }

  void describe(auto&& parameter) const {
    parameter("probability", probability, "1");
    parameter("standard deviation", standard_deviation, SensorUnit{});
  }
};

template <typename P, typename Q>
Spikes(const P&, const Q&) -> Spikes<detail::ScalarOfParameter<P>, detail::values_in_parameters<P, Q>>;

}  // namespace splinertia
