// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/imu/imu_sensor_sample.hpp>
#include <string_view>

namespace splinertia {

/// The sensitivity of a gyroscope to specific force: the true specific force f adds G·f to the reading. G is 3×3, in
/// rad/s per m/s², in the axes of the IMU. Kalibr's A, OpenVINS' T_g.
template <typename Scalar = double>
struct GSensitivity {
  static constexpr std::string_view name = "g-sensitivity";
  static constexpr SensorKind sensor = SensorKind::gyro;
  struct State {};

  Eigen::Matrix3<Scalar> sensitivity;

  /// Throws std::invalid_argument unless all elements and their third powers are finite.
  GSensitivity(const Eigen::Matrix3<Scalar>& sensitivity_) : sensitivity(sensitivity_) {
    detail::require_factor("GSensitivity", "sensitivity", sensitivity);
  }

  void apply(ImuSensorSample<Scalar>& sample, State&) const { sample.value += sensitivity * sample.truth.accel; }

  void describe(auto&& parameter) const { parameter("sensitivity", sensitivity, "rad/s/(m/s^2)"); }
};

template <typename P>
GSensitivity(const P&) -> GSensitivity<detail::ScalarOfParameter<P>>;

}  // namespace splinertia
