// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/bias/temperature.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A bias proportional to the deviation from a reference temperature: coefficient·(T(t) − reference). Coefficient in
/// the sensor's unit per K, temperatures in °C. For T(t) see temperature.hpp.
template <typename Scalar, TemperatureProfile<Scalar> Profile, int N = 1>
struct TemperatureBias {
  static constexpr std::string_view name = "temperature bias";
  struct State {};

  PerAxis<Scalar, N> coefficient;
  Profile temperature;
  Scalar reference;

  /// Throws std::invalid_argument unless coefficient, reference and their third powers are finite.
  constexpr TemperatureBias(const PerAxis<Scalar, N>& coefficient_, const Profile& temperature_,
                            const Scalar& reference_ = Scalar(25))
      : coefficient(coefficient_), temperature(temperature_), reference(reference_) {
    detail::require_factor("TemperatureBias", "coefficient", coefficient);
    detail::require_factor("TemperatureBias", "reference temperature", reference);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    const AxisVector<Scalar, Axes> bias =
        coefficient.template vector<Axes>() * (Scalar(temperature(sample.elapsed)) - reference);
    sample.value += bias;
    sample.bias += bias;
  }

  void describe(auto&& parameter) const {
    parameter("coefficient", coefficient, SensorUnit{.per_kelvin = true});
    detail::describe_profile(temperature, parameter);
    parameter("reference temperature", reference, "degC");
  }
};

template <typename P, typename Profile, typename... More>
TemperatureBias(const P&, const Profile&, const More&...)
    -> TemperatureBias<detail::ScalarOfParameter<P>, Profile, detail::values_in_parameter<P>>;

}  // namespace splinertia
