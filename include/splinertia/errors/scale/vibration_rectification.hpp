// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Vibration rectification of an accelerometer: the reading so far, x, becomes x + K₂·x², the second-order term of the
/// model equation of IEEE Std 1293 (linear accelerometers). Vibration of standard deviation σ about a mean m shifts the
/// mean of the readings by K₂·(m² + σ²). Data sheets give K₂ as the vibration rectification error, the shift divided by
/// σ²: 1 µg/g² rms is 1e-6/9.80665 s²/m. They remove the part K₂·m², which is there at rest, too, with the bias.
///
/// K₂ in 1/(the sensor's unit). Write it after the terms that vibrate and before the noise. The error does not count as
/// bias. See imu/errors/g_squared_sensitivity.hpp for gyroscopes.
template <typename Scalar = double, int N = 1>
struct VibrationRectification {
  static constexpr std::string_view name = "vibration rectification";
  struct State {};

  PerAxis<Scalar, N> coefficient;

  /// Throws std::invalid_argument unless the coefficient and its third power are finite.
  constexpr VibrationRectification(const PerAxis<Scalar, N>& coefficient_) : coefficient(coefficient_) {
    detail::require_factor("VibrationRectification", "coefficient", coefficient);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    const AxisVector<Scalar, Axes> slope = coefficient.template vector<Axes>().cwiseProduct(sample.value);
    sample.value += slope.cwiseProduct(sample.value);
  }

  void describe(auto&& parameter) const { parameter("coefficient", coefficient, SensorUnit{.reciprocal = true}); }
};

template <typename P>
VibrationRectification(const P&)
    -> VibrationRectification<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
