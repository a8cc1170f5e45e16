// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <splinertia/errors/noise_densities.hpp>
#include <string_view>

namespace splinertia::allan {

/// The noise terms of IEEE Std 952-1997, annex C, and two that real biases have beside them, in units of a signal u;
/// the terms of imu/ that simulate them.
enum class NoiseTerm : std::size_t {
  white,             ///< N, angle or velocity random walk, u/√Hz (WhiteNoise)
  random_walk,       ///< K, rate random walk, u/s/√Hz (RandomWalk)
  bias_instability,  ///< B, flicker noise, u; a data sheet's in-run stability is 0.664·B (BiasInstability)
  quantization,      ///< Q, white noise of the integral, u·s (QuantizationNoise)
  rate_ramp,         ///< R, drift, u/s (RateRamp)
  gauss_markov,      ///< G, standard deviation of a bias that forgets with a correlation time, u
  warm_up            ///< W, height of a drift A·exp(−t/T) that settles, u
};

/// The five of IEEE Std 952, each of which has one coefficient.
inline constexpr std::array<NoiseTerm, 5> standard_terms{NoiseTerm::white, NoiseTerm::random_walk,
                                                         NoiseTerm::bias_instability, NoiseTerm::quantization,
                                                         NoiseTerm::rate_ramp};

inline constexpr std::array<NoiseTerm, 7> noise_terms{
    NoiseTerm::white,     NoiseTerm::random_walk,  NoiseTerm::bias_instability, NoiseTerm::quantization,
    NoiseTerm::rate_ramp, NoiseTerm::gauss_markov, NoiseTerm::warm_up};

/// N, K, B, Q, R, G, W.
[[nodiscard]] constexpr std::string_view symbol(NoiseTerm term) {
  return std::array<std::string_view, 7>{"N", "K", "B", "Q", "R", "G", "W"}[static_cast<std::size_t>(term)];
}

[[nodiscard]] constexpr std::string_view name(NoiseTerm term) {
  return std::array<std::string_view, 7>{"white noise", "random walk",       "bias instability", "quantization noise",
                                         "rate ramp",   "Gauss-Markov bias", "warm-up"}[static_cast<std::size_t>(term)];
}

/// Which of the terms a model has.
class NoiseTerms {
 public:
  constexpr NoiseTerms() = default;
  constexpr NoiseTerms(std::initializer_list<NoiseTerm> terms) {
    for (const NoiseTerm term : terms) bits_ |= bit(term);
  }
  static constexpr unsigned sets = 128;
  [[nodiscard]] static constexpr NoiseTerms all() { return numbered(sets - 1); }
  /// One of 0 … sets − 1, each another set.
  [[nodiscard]] static constexpr NoiseTerms numbered(unsigned bits) {
    NoiseTerms result;
    result.bits_ = bits;
    return result;
  }
  [[nodiscard]] constexpr unsigned number() const { return bits_; }
  [[nodiscard]] constexpr bool has(NoiseTerm term) const { return (bits_ & bit(term)) != 0; }
  [[nodiscard]] constexpr NoiseTerms with(NoiseTerm term) const { return numbered(bits_ | bit(term)); }
  [[nodiscard]] constexpr NoiseTerms without(NoiseTerm term) const { return numbered(bits_ & ~bit(term)); }
  [[nodiscard]] constexpr bool within(NoiseTerms other) const { return (bits_ & ~other.bits_) == 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool operator==(const NoiseTerms&) const = default;

 private:
  [[nodiscard]] static constexpr unsigned bit(NoiseTerm term) { return 1u << static_cast<unsigned>(term); }
  unsigned bits_ = 0;
};

/// What a standard term of coefficient 1 has at averaging time tau [s], in u²: 1/tau, tau/3, 2 ln 2/π, 3/tau², tau²/2.
/// IEEE Std 952-1997, C.1. Zero for the others, which have no coefficient alone.
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
    case NoiseTerm::gauss_markov:
    case NoiseTerm::warm_up:
      break;
  }
  return Scalar(0);
}

/// What a Gauss-Markov bias of standard deviation 1 u and this correlation time [s] has at averaging time tau [s], in
/// u²: 2/x·(1 − (3 − 4e^(−x) + e^(−2x))/(2x)) with x = tau/correlation_time. IEEE Std 952-1997, C.1.5 (there with the
/// density of what drives it). Below x = 1/100 by its series 2x/3·(1 − 3x/4), which is within 4e-5 there.
template <typename Scalar>
[[nodiscard]] Scalar gauss_markov_allan_variance(const Scalar& tau, const Scalar& correlation_time) {
  const Scalar x = tau / correlation_time;
  if (x < Scalar(1) / 100) return 2 * x / 3 * (1 - 3 * x / 4);
  // 3 − 4e^(−x) + e^(−2x) = 2(1 − e^(−x)) + (1 − e^(−x))², which does not cancel.
  const Scalar lost = -std::expm1(-x);
  return 2 / x * (1 - (2 * lost + lost * lost) / (2 * x));
}

/// What a drift exp(−t/decay_time), t = 0 … duration, has at averaging time tau [s], averaged over all places of the
/// log where two averages fit: half the square of (1 − e^(−x))²/x, x = tau/decay_time, times the mean of
/// e^(−2t/decay_time) over them.
template <typename Scalar>
[[nodiscard]] Scalar warm_up_allan_variance(const Scalar& tau, const Scalar& decay_time, const Scalar& duration) {
  const Scalar x = tau / decay_time, lost = -std::expm1(-x);
  const Scalar difference = lost * lost / x;
  const Scalar places = 2 * (std::max)(duration - 2 * tau, Scalar(0)) / decay_time;
  const Scalar mean = places > 0 ? -std::expm1(-places) / places : Scalar(1);
  return difference * difference / 2 * mean;
}

}  // namespace splinertia::allan
