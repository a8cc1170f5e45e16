// SPDX-License-Identifier: MIT
/// The noise of an IMU as estimators ask for it: four densities.
#pragma once

#include <cmath>
#include <concepts>
#include <string_view>
#include <tuple>

namespace splinertia {

/// Noise densities of an IMU in continuous time, in the units of WhiteNoise and RandomWalk.
template <typename Scalar = double>
struct ImuNoise {
  Scalar gyro_density;   ///< N, rad/s/√Hz
  Scalar accel_density;  ///< N, m/s²/√Hz
  Scalar gyro_walk;      ///< K, rad/s²/√Hz
  Scalar accel_walk;     ///< K, m/s³/√Hz
};

namespace detail {

/// The root sum of squares of the densities of the terms of this name; of a term that has one for each axis, the
/// largest counts.
template <typename Scalar, typename Model>
[[nodiscard]] Scalar density_of(const Model& model, std::string_view name) {
  using std::sqrt;
  Scalar sum(0);
  const auto add = [&](const auto& term) {
    if constexpr (requires {
                    { term.name } -> std::convertible_to<std::string_view>;
                    term.density.begin();
                  }) {
      if (term.name != name) return;
      Scalar largest(0);
      for (const auto& density : term.density) {
        if (Scalar(density) > largest) largest = Scalar(density);
      }
      sum += largest * largest;
    }
  };
  std::apply([&](const auto&... term) { (add(term), ...); }, model.terms());
  return sqrt(sum);
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
template <typename Scalar = double, typename Sensors>
  requires requires(const Sensors& imu) {
    imu.gyro.terms();
    imu.accel.terms();
  }
[[nodiscard]] ImuNoise<Scalar> imu_noise(const Sensors& imu) {
  constexpr std::string_view white = "white noise", walk = "random walk";
  return {detail::density_of<Scalar>(imu.gyro, white), detail::density_of<Scalar>(imu.accel, white),
          detail::density_of<Scalar>(imu.gyro, walk), detail::density_of<Scalar>(imu.accel, walk)};
}

}  // namespace splinertia
