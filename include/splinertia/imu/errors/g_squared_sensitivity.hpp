// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/imu/imu_sensor_sample.hpp>
#include <string_view>

namespace splinertia {

/// The sensitivity of a gyroscope to the square of specific force: the true specific force f adds k_i·f_i² to axis i of
/// the reading. k in rad/s per (m/s²)², in the axes of the IMU. Vibration of standard deviation σ shifts the mean by
/// k·σ²: data sheets call k vibration rectification. IEEE Std 528 (inertial sensor terminology),
/// "acceleration-squared-sensitive drift rate"; products of different axes are left out. The true force is that of the
/// motion, without the vibration terms of the accelerometer's model.
template <typename Scalar = double, int N = 1>
struct GSquaredSensitivity {
  static constexpr std::string_view name = "g-squared sensitivity";
  static constexpr SensorKind sensor = SensorKind::gyro;
  struct State {};

  PerAxis<Scalar, N> sensitivity;

  /// Throws std::invalid_argument unless the sensitivity and its third power are finite.
  constexpr GSquaredSensitivity(const PerAxis<Scalar, N>& sensitivity_) : sensitivity(sensitivity_) {
    detail::require_factor("GSquaredSensitivity", "sensitivity", sensitivity);
  }

  void apply(ImuSensorSample<Scalar>& sample, State&) const {
    // Not k times f²: no zero is multiplied by an overflow.
    const Eigen::Vector3<Scalar> slope = sensitivity.template vector<3>().cwiseProduct(sample.truth.accel);
    sample.value += slope.cwiseProduct(sample.truth.accel);
  }

  void describe(auto&& parameter) const { parameter("sensitivity", sensitivity, "rad/s/(m/s^2)^2"); }
};

template <typename P>
GSquaredSensitivity(const P&) -> GSquaredSensitivity<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
