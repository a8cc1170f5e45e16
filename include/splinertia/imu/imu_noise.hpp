// SPDX-License-Identifier: MIT
/// The noise of an IMU as estimators ask for it: four densities.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>

namespace splinertia {

// Declared only: estimators need ImuNoise without the error terms.
template <typename Scalar, int N>
struct WhiteNoise;
template <typename Scalar, int N>
struct RandomWalk;
template <typename... Terms>
class ErrorModel;
template <typename Gyro, typename Accel, typename Stamps>
struct Imu;

/// Noise densities of an IMU in continuous time, in the units of WhiteNoise and RandomWalk.
template <typename Scalar = double>
struct ImuNoise {
  Scalar gyro_density;   ///< N, rad/s/√Hz
  Scalar accel_density;  ///< N, m/s²/√Hz
  Scalar gyro_walk;      ///< K, rad/s²/√Hz
  Scalar accel_walk;     ///< K, m/s³/√Hz
};

namespace detail {

/// The density of a term of the kind Noise, the largest if it has one for each axis; 0 for other terms.
template <template <typename, int> typename Noise, typename Scalar, typename Term>
[[nodiscard]] Scalar density_of(const Term&) {
  return Scalar(0);
}
template <template <typename, int> typename Noise, typename Scalar, typename S, int N>
[[nodiscard]] Scalar density_of(const Noise<S, N>& term) {
  return Scalar(*std::max_element(term.density.begin(), term.density.end()));
}

/// The root sum of squares of the densities of all such terms of a model.
template <template <typename, int> typename Noise, typename Scalar, typename... Terms>
[[nodiscard]] Scalar total_density(const ErrorModel<Terms...>& model) {
  using std::sqrt;
  const auto square = [](const Scalar& x) { return x * x; };
  return std::apply(
      [&](const auto&... term) { return sqrt((Scalar(0) + ... + square(density_of<Noise, Scalar>(term)))); },
      model.terms());
}

}  // namespace detail

/// The densities of an Imu's WhiteNoise and RandomWalk terms, for preintegrate() and estimators:
///
///   preintegrate<Midpoint>(samples, bias, imu_noise(presets::euroc))
///
/// Several terms of a kind add up as the root of the sum of their squares. If a term has a value for each axis, the
/// largest counts, so that the noise of no axis is underestimated. All other terms are ignored: turn-on and other
/// biases, BiasInstability, GaussMarkov, QuantizationNoise, vibration, scale and bandwidth are not what these four
/// numbers can express.
template <typename Scalar = double, typename... Gyro, typename... Accel, typename Stamps>
[[nodiscard]] ImuNoise<Scalar> imu_noise(const Imu<ErrorModel<Gyro...>, ErrorModel<Accel...>, Stamps>& imu) {
  return {detail::total_density<WhiteNoise, Scalar>(imu.gyro), detail::total_density<WhiteNoise, Scalar>(imu.accel),
          detail::total_density<RandomWalk, Scalar>(imu.gyro), detail::total_density<RandomWalk, Scalar>(imu.accel)};
}

}  // namespace splinertia
