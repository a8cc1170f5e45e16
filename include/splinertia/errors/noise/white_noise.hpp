// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/square_root.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// White noise (angle or velocity random walk) of density N: adds N/√interval · n, n standard normal, to every sample.
/// N in unit/√Hz: rad/s/√Hz for a gyroscope, m/s²/√Hz for an accelerometer. IEEE Std 952-1997, C.1.1.
template <typename Scalar = double, int N = 1>
struct WhiteNoise {
  static constexpr std::string_view name = "white noise";
  template <typename Normals>
  using State = Normals;

  PerAxis<Scalar, N> density;

  /// Throws std::invalid_argument unless the density and its third power are finite and >= 0.
  constexpr WhiteNoise(const PerAxis<Scalar, N>& density_) : density(density_) {
    detail::require_noise_factor("WhiteNoise", "density", density);
  }

  template <int Axes>
  SPLINERTIA_ALWAYS_INLINE void apply(SensorSample<Scalar, Axes>& sample, auto& normals) const {
    const Scalar per_root_second = Scalar(1) / detail::square_root(sample.interval);
    sample.value += (density.template vector<Axes>() * per_root_second).cwiseProduct(normals.template draw<Scalar>());
  }

  void describe(auto&& parameter) const { parameter("density", density, SensorUnit{0, true}); }
};

template <typename P>
WhiteNoise(const P&) -> WhiteNoise<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
