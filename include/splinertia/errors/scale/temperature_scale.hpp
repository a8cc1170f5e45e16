// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/bias/temperature.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A scale factor error proportional to the deviation from a reference temperature: the reading and the bias in it are
/// multiplied by 1 + coefficient·(T(t) − reference). Coefficient per K, temperatures in °C. For T(t) see
/// temperature.hpp.
template <typename Scalar, TemperatureProfile<Scalar> Profile, int N = 1>
struct TemperatureScale {
  static constexpr std::string_view name = "temperature scale";
  struct State {};

  PerAxis<Scalar, N> coefficient;
  Profile temperature;
  Scalar reference;

  /// Throws std::invalid_argument unless coefficient, reference and their third powers are finite.
  constexpr TemperatureScale(const PerAxis<Scalar, N>& coefficient_, const Profile& temperature_,
                             const Scalar& reference_ = Scalar(25))
      : coefficient(coefficient_), temperature(temperature_), reference(reference_) {
    detail::require_factor("TemperatureScale", "coefficient", coefficient);
    detail::require_factor("TemperatureScale", "reference temperature", reference);
  }

  template <int Axes>
  void apply(SensorSample<Scalar, Axes>& sample, State&) const {
    const AxisVector<Scalar, Axes> error =
        coefficient.template vector<Axes>() * (Scalar(temperature(sample.elapsed)) - reference);
    sample.value += error.cwiseProduct(sample.value);
    sample.bias += error.cwiseProduct(sample.bias);
  }

  void describe(auto&& parameter) const {
    parameter("coefficient", coefficient, "1/K");
    detail::describe_profile(temperature, parameter);
    parameter("reference temperature", reference, "degC");
  }
};

template <typename P, typename Profile, typename... More>
TemperatureScale(const P&, const Profile&, const More&...)
    -> TemperatureScale<detail::ScalarOfParameter<P>, Profile, detail::values_in_parameter<P>>;

}  // namespace splinertia
