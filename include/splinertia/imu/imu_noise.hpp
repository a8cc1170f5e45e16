// SPDX-License-Identifier: MIT
/// The noise of an IMU as estimators ask for it: four densities.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace splinertia {

// Declared only: estimators need ImuNoise without the error terms.
template <typename Scalar, int N>
struct WhiteNoise;
template <typename Scalar, int N>
struct CorrelatedNoise;
template <typename Scalar, int N>
struct RandomWalk;
template <typename... Terms>
class ErrorModel;
template <typename Gyro, typename Accel, typename Stamps>
struct Imu;

/// Noise densities of an IMU in continuous time, in the units of WhiteNoise, CorrelatedNoise and RandomWalk.
template <typename Scalar = double>
struct ImuNoise {
  Scalar gyro_density;   ///< N, rad/s/√Hz
  Scalar accel_density;  ///< N, m/s²/√Hz
  Scalar gyro_walk;      ///< K, rad/s²/√Hz
  Scalar accel_walk;     ///< K, m/s³/√Hz
};

namespace detail {

/// Whether a term is white noise, and whether it is a random walk.
template <typename Term>
inline constexpr bool is_white_noise = false;
template <typename Scalar, int N>
inline constexpr bool is_white_noise<WhiteNoise<Scalar, N>> = true;
template <typename Scalar, int N>
inline constexpr bool is_white_noise<CorrelatedNoise<Scalar, N>> = true;
template <typename Term>
inline constexpr bool is_random_walk = false;
template <typename Scalar, int N>
inline constexpr bool is_random_walk<RandomWalk<Scalar, N>> = true;

/// The density of a term, the largest if it has one for each axis; 0 unless it `counts`.
template <typename Scalar, bool counts, typename Term>
[[nodiscard]] Scalar density_of(const Term& term) {
  if constexpr (counts) {
    return Scalar(*std::max_element(term.density.begin(), term.density.end()));
  } else {
    return Scalar(0);
  }
}

/// The root of the sum of squares, whose squares neither overflow nor underflow.
template <typename Scalar, std::size_t Count>
[[nodiscard]] Scalar root_sum_square(const std::array<Scalar, Count>& values) {
  using std::sqrt;
  Scalar largest(0), sum(0);
  for (const Scalar& x : values) largest = largest < x ? x : largest;
  if (!(largest > Scalar(0))) return Scalar(0);
  for (const Scalar& x : values) sum += (x / largest) * (x / largest);
  return largest * sqrt(sum);
}

template <typename Scalar, typename... Terms>
[[nodiscard]] Scalar total_white_noise(const ErrorModel<Terms...>& model) {
  return std::apply(
      [](const auto&... term) {
        return root_sum_square<Scalar, sizeof...(term)>({density_of<Scalar, is_white_noise<Terms>>(term)...});
      },
      model.terms());
}
template <typename Scalar, typename... Terms>
[[nodiscard]] Scalar total_random_walk(const ErrorModel<Terms...>& model) {
  return std::apply(
      [](const auto&... term) {
        return root_sum_square<Scalar, sizeof...(term)>({density_of<Scalar, is_random_walk<Terms>>(term)...});
      },
      model.terms());
}

}  // namespace detail

/// The densities of an Imu's WhiteNoise and CorrelatedNoise terms, and of its RandomWalk terms, for preintegrate() and
/// estimators:
///
///   preintegrate<Midpoint>(samples, bias, imu_noise(presets::euroc))
///
/// Several terms of a kind add up as the root of the sum of their squares. If a term has a value for each axis, the
/// largest counts, so that the noise of no axis is underestimated. What these four numbers cannot express is ignored:
/// the correlation between axes, and all other terms. These are turn-on and other biases, BiasInstability, GaussMarkov,
/// QuantizationNoise, Quantization, Spikes, StuckReadings, vibration, temperature, scale, misalignment, sensitivity to
/// force, saturation, bandwidth, and the errors of the stamps.
template <typename Scalar = double, typename... Gyro, typename... Accel, typename Stamps>
[[nodiscard]] ImuNoise<Scalar> imu_noise(const Imu<ErrorModel<Gyro...>, ErrorModel<Accel...>, Stamps>& imu) {
  return {detail::total_white_noise<Scalar>(imu.gyro), detail::total_white_noise<Scalar>(imu.accel),
          detail::total_random_walk<Scalar>(imu.gyro), detail::total_random_walk<Scalar>(imu.accel)};
}

}  // namespace splinertia
