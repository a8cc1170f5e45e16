// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Rounds the reading to the nearest multiple of the least significant bit (resolution), in the sensor's unit. See
/// quantization_noise.hpp for the coefficient Q of IEEE Std 952.
template <typename Scalar = double>
struct Quantization {
  static constexpr std::string_view name = "quantization";
  struct State {};

  PerAxis<Scalar> least_significant_bit;

  /// Throws std::invalid_argument unless the bit is finite and > 0.
  constexpr Quantization(const PerAxis<Scalar>& least_significant_bit_)
      : least_significant_bit(least_significant_bit_) {
    require_positive("Quantization", "least significant bit", least_significant_bit);
  }

  void apply(Sample<Scalar>& sample, State&) const {
    using std::round;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Scalar& value = sample.value[static_cast<int>(axis)];
      const Scalar counts = round(value / least_significant_bit[axis]);
      if (is_finite(counts))
        value = counts * least_significant_bit[axis];  // else the bit is smaller than the rounding of the value
    }
  }

  void describe(auto&& parameter) const { parameter("least significant bit", least_significant_bit, SensorUnit{}); }
};

template <typename P>
Quantization(const P&) -> Quantization<ScalarOfParameter<P>>;

}  // namespace splinertia
