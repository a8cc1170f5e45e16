// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A sensor that sticks now and then: for a while all axes repeat the last reading, and the bias in it. After a fresh
/// sample the sensor sticks with the given probability p. The number of repeated samples in a row then has a geometric
/// distribution with the given mean length L. In the long run the fraction pL/(1 + pL) of the samples repeat. The first
/// sample of a run is fresh. Two-state Markov chain: Gilbert, "Capacity of a Burst-Noise Channel", Bell Syst. Tech. J.
/// 39 (1960).
template <typename Scalar = double>
struct StuckReadings {
  static constexpr std::string_view name = "stuck readings";
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : random(term) {}
    Normals random;
    bool stuck = false;
    AxisVector<Scalar, Normals::axes> value, bias;
  };

  Scalar probability;
  Scalar mean_length;

  /// Throws std::invalid_argument unless 0 <= probability <= 1 and the mean length is finite and >= 1.
  constexpr StuckReadings(const Scalar& probability_, const Scalar& mean_length_ = Scalar(1))
      : probability(probability_), mean_length(mean_length_) {
    detail::require(probability >= Scalar(0) && probability <= Scalar(1), "StuckReadings", "probability", probability,
                    "a number >= 0 and <= 1");
    detail::require(detail::is_finite(mean_length) && mean_length >= Scalar(1), "StuckReadings", "mean length",
                    mean_length, "a finite number >= 1");
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    const double u = state.random.uniform();
    const bool continues = state.stuck && !(u < Scalar(1) / mean_length);
    state.stuck = !sample.first && (continues || (!state.stuck && u < probability));
    if (!state.stuck) {
      state.value = sample.value;
      state.bias = sample.bias;
    }
    sample.value = state.value;
    sample.bias = state.bias;
  }

  void describe(auto&& parameter) const {
    parameter("probability", probability, "1");
    parameter("mean length", mean_length, "samples");
  }
};

template <typename P, typename... More>
StuckReadings(const P&, const More&...) -> StuckReadings<detail::ScalarOfParameter<P>>;

}  // namespace splinertia
