// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <splinertia/imu/error_term.hpp>
#include <splinertia/imu/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// White noise (angle or velocity random walk) of density N: adds N/√interval · n, n standard normal, to every sample.
/// N in unit/√Hz: rad/s/√Hz for a gyroscope, m/s²/√Hz for an accelerometer. IEEE Std 952-1997, C.1.1.
template <typename Scalar = double>
struct WhiteNoise {
  static constexpr std::string_view name = "white noise";
  using State = NormalStreams;

  PerAxis<Scalar> density;

  /// Throws std::invalid_argument unless the density is finite and >= 0.
  constexpr WhiteNoise(const PerAxis<Scalar>& density_) : density(density_) {
    density.require_non_negative("WhiteNoise", "density");
  }

  void apply(Sample<Scalar>& sample, State& normal) const {
    using std::sqrt;
    const Scalar per_root_second = Scalar(1) / sqrt(sample.interval);
    const Vector3<Scalar> n = normal.draw<Scalar>();
    for (int axis = 0; axis < 3; ++axis)
      sample.value[axis] += density[static_cast<std::size_t>(axis)] * per_root_second * n[axis];
  }
};

template <std::floating_point Scalar>
WhiteNoise(Scalar) -> WhiteNoise<Scalar>;
template <typename Scalar>
WhiteNoise(const Vector3<Scalar>&) -> WhiteNoise<Scalar>;

}  // namespace splinertia
