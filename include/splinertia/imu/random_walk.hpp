// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <splinertia/imu/error_term.hpp>
#include <splinertia/imu/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// A bias that walks at random (rate random walk) with density K: it is zero at the first sample and moves by
/// K·√interval · n, n standard normal, before every other. The bias is in the sample that it is reported with.
/// K in unit/s/√Hz: rad/s²/√Hz for a gyroscope, m/s³/√Hz for an accelerometer. IEEE Std 952-1997, C.1.3.
template <typename Scalar = double>
struct RandomWalk {
  static constexpr std::string_view name = "random walk";
  struct State {
    explicit State(StreamKey term) : normal(term) {}
    NormalStreams normal;
    Vector3<Scalar> bias = Vector3<Scalar>::Zero();
  };

  PerAxis<Scalar> density;

  /// Throws std::invalid_argument unless the density is finite and >= 0.
  constexpr RandomWalk(const PerAxis<Scalar>& density_) : density(density_) {
    density.require_non_negative("RandomWalk", "density");
  }

  void apply(Sample<Scalar>& sample, State& state) const {
    using std::sqrt;
    if (!sample.first) {
      const Scalar root_interval = sqrt(sample.interval);
      const Vector3<Scalar> n = state.normal.template draw<Scalar>();
      for (int axis = 0; axis < 3; ++axis)
        state.bias[axis] += density[static_cast<std::size_t>(axis)] * root_interval * n[axis];
    }
    sample.value += state.bias;
    sample.bias += state.bias;
  }
};

template <std::floating_point Scalar>
RandomWalk(Scalar) -> RandomWalk<Scalar>;
template <typename Scalar>
RandomWalk(const Vector3<Scalar>&) -> RandomWalk<Scalar>;

}  // namespace splinertia
