// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Quantization noise of coefficient Q. At the end of every interval the integral of the reading (angle, velocity) has
/// the error q_i = Q·n_i, n_i standard normal and independent. The error of sample i is therefore
/// (q_i − q_{i−1})/interval.
/// Allan deviation √3·Q/τ. IEEE Std 952-1997, C.1.5. Q in the sensor's unit times s: rad for a gyroscope, m/s for an
/// accelerometer. A sensor that counts increments of size Δ has Q = Δ/√12. See quantization.hpp for rounding of the
/// reading itself.
template <typename Scalar = double, int N = 1>
struct QuantizationNoise {
  static constexpr std::string_view name = "quantization noise";
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : normals(term), previous(normals.template draw<Scalar>()) {}
    Normals normals;
    AxisVector<Scalar, Normals::axes> previous;
  };

  PerAxis<Scalar, N> coefficient;

  /// Throws std::invalid_argument unless Q is finite and >= 0.
  constexpr QuantizationNoise(const PerAxis<Scalar, N>& coefficient_) : coefficient(coefficient_) {
    detail::require_non_negative("QuantizationNoise", "coefficient Q", coefficient);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    const AxisVector<Scalar, Axes> n = state.normals.template draw<Scalar>();
    sample.value += coefficient.template vector<Axes>().cwiseProduct(n - state.previous) / sample.interval;
    state.previous = n;
  }

  void describe(auto&& parameter) const { parameter("coefficient Q", coefficient, SensorUnit{-1}); }
};

template <typename P>
QuantizationNoise(const P&) -> QuantizationNoise<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
