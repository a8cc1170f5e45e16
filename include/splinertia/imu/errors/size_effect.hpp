// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/imu/imu_sensor_sample.hpp>
#include <string_view>

namespace splinertia {

/// The size effect: an accelerometer i at r_i from the origin of the IMU measures the acceleration there, and its
/// reading gains (α × r_i + ω × (ω × r_i))_i. Column i of the 3×3 matrix is r_i, m, in the axes of the IMU. Rehder,
/// Nikolic, Schneider, Hinzmann, Siegwart, "Extending kalibr", ICRA 2016. It does not count as bias.
///
/// α is the derivative of the parabola through the last three true ω. Its error is h₁(h₁ + h₀)/6 times the third
/// derivative of ω, with the last two intervals h₁ and h₀: h²/3 at a constant interval. The second sample takes the
/// difference of two (error h/2 times the second derivative), the first takes α = 0.
template <typename Scalar = double>
struct SizeEffect {
  static constexpr std::string_view name = "size effect";
  static constexpr SensorKind sensor = SensorKind::accel;
  struct State {
    Eigen::Vector3<Scalar> rate, slope;  // ω, and its last difference quotient
    Scalar interval = Scalar(0);         // of `slope`; 0 as long as there is none
  };

  Eigen::Matrix3<Scalar> positions;

  /// Throws std::invalid_argument unless all positions and their third powers are finite.
  SizeEffect(const Eigen::Matrix3<Scalar>& positions_) : positions(positions_) {
    for (int i = 0; i < 9; ++i) detail::require_factor("SizeEffect", "position", positions(i / 3, i % 3));
  }

  void apply(ImuSensorSample<Scalar>& sample, State& state) const {
    const Eigen::Vector3<Scalar>& rate = sample.truth.gyro;
    Eigen::Vector3<Scalar> alpha = Eigen::Vector3<Scalar>::Zero();
    if (!sample.first) {
      const Scalar h = sample.interval;
      const Eigen::Vector3<Scalar> slope = (rate - state.rate) / h;
      alpha = slope;
      if (state.interval > Scalar(0)) alpha += (slope - state.slope) * (h / (h + state.interval));
      state.slope = slope;
      state.interval = h;
    }
    state.rate = rate;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3<Scalar> r = positions.col(i);
      sample.value[i] += (alpha.cross(r) + rate.cross(rate.cross(r)))[i];
    }
  }

  void describe(auto&& parameter) const { parameter("positions", positions, "m"); }
};

template <typename P>
SizeEffect(const P&) -> SizeEffect<detail::ScalarOfParameter<P>>;

}  // namespace splinertia
