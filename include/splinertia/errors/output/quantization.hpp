// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Rounds the reading to the nearest multiple of the least significant bit (resolution), in the sensor's unit. See
/// quantization_noise.hpp for the coefficient Q of IEEE Std 952.
template <typename Scalar = double, int N = 1>
struct Quantization {
  static constexpr std::string_view name = "quantization";
  struct State {};

  PerAxis<Scalar, N> least_significant_bit;

  /// Throws std::invalid_argument unless the bit is finite and > 0.
  constexpr Quantization(const PerAxis<Scalar, N>& least_significant_bit_)
      : least_significant_bit(least_significant_bit_) {
    detail::require_positive("Quantization", "least significant bit", least_significant_bit);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    using std::round;
    const auto bit = least_significant_bit.template view<Axes>();
    for (int i = 0; i < Axes; ++i) {
      Scalar& value = sample.value[i];
      const Scalar counts = round(value / bit[i]);
      if (detail::is_finite(counts)) value = counts * bit[i];  // else the bit is smaller than the rounding of the value
    }
  }

  void describe(auto&& parameter) const { parameter("least significant bit", least_significant_bit, SensorUnit{}); }
};

template <typename P>
Quantization(const P&) -> Quantization<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
