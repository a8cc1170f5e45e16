// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/imu/noise_densities.hpp>
#include <string_view>

namespace splinertia::allan {

/// The noise terms of IEEE Std 952-1997, annex C, in units of a signal u; the terms of imu/ that simulate them.
enum class NoiseTerm : std::size_t {
  white,             ///< N, angle or velocity random walk, u/√Hz (WhiteNoise)
  random_walk,       ///< K, rate random walk, u/s/√Hz (RandomWalk)
  bias_instability,  ///< B, flicker noise, u; a data sheet's in-run stability is 0.664·B (BiasInstability)
  quantization,      ///< Q, white noise of the integral, u·s (QuantizationNoise)
  rate_ramp          ///< R, drift, u/s (RateRamp)
};

inline constexpr std::array<NoiseTerm, 5> noise_terms{NoiseTerm::white, NoiseTerm::random_walk,
                                                      NoiseTerm::bias_instability, NoiseTerm::quantization,
                                                      NoiseTerm::rate_ramp};

/// N, K, B, Q, R.
[[nodiscard]] constexpr std::string_view symbol(NoiseTerm term) {
  return std::array<std::string_view, 5>{"N", "K", "B", "Q", "R"}[static_cast<std::size_t>(term)];
}

[[nodiscard]] constexpr std::string_view name(NoiseTerm term) {
  return std::array<std::string_view, 5>{"white noise", "random walk", "bias instability", "quantization noise",
                                         "rate ramp"}[static_cast<std::size_t>(term)];
}

/// What a term of coefficient 1 has at averaging time tau [s], in u²: 1/tau, tau/3, 2 ln 2/π, 3/tau², tau²/2.
/// IEEE Std 952-1997, C.1.
template <typename Scalar>
[[nodiscard]] Scalar allan_variance(NoiseTerm term, const Scalar& tau) {
  switch (term) {
    case NoiseTerm::white:
      return 1 / tau;
    case NoiseTerm::random_walk:
      return tau / 3;
    case NoiseTerm::bias_instability: {
      constexpr auto floor = allan_floor_over_bias_instability<Scalar>();
      return floor * floor;
    }
    case NoiseTerm::quantization:
      return 3 / (tau * tau);
    case NoiseTerm::rate_ramp:
      return tau * tau / 2;
  }
  return Scalar(0);
}

}  // namespace splinertia::allan
