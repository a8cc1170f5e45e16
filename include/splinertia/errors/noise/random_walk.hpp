// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/square_root.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A bias that is a random walk (rate random walk) of density K. It is zero at the first sample; before every other
/// sample it changes by K·√interval · n, n standard normal. The bias reported with a sample is the one contained in it.
/// K in unit/s/√Hz: rad/s²/√Hz for a gyroscope, m/s³/√Hz for an accelerometer. IEEE Std 952-1997, C.1.3.
template <typename Scalar = double, int N = 1>
struct RandomWalk {
  static constexpr std::string_view name = "random walk";
  template <typename Normals>
  struct State {
    explicit State(StreamKey term) : normals(term) {}
    Normals normals;
    AxisVector<Scalar, Normals::axes> bias = AxisVector<Scalar, Normals::axes>::Zero();
  };

  PerAxis<Scalar, N> density;

  /// Throws std::invalid_argument unless the density and its third power are finite and >= 0.
  constexpr RandomWalk(const PerAxis<Scalar, N>& density_) : density(density_) {
    detail::require_noise_factor("RandomWalk", "density", density);
  }

  template <int Axes>
  SPLINERTIA_ALWAYS_INLINE void apply(SensorSample<Scalar, Axes>& sample, auto& state) const {
    if (!sample.first) {
      state.bias += (density.template vector<Axes>() * detail::square_root(sample.interval))
                        .cwiseProduct(state.normals.template draw<Scalar>());
    }
    sample.value += state.bias;
    sample.bias += state.bias;
  }

  void describe(auto&& parameter) const { parameter("density", density, SensorUnit{1, true}); }
};

template <typename P>
RandomWalk(const P&) -> RandomWalk<detail::ScalarOfParameter<P>, detail::values_in_parameters<P>>;

}  // namespace splinertia
