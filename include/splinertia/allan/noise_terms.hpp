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

/// The five noise terms of IEEE Std 952-1997, annex C, and two more that real biases show. u is the unit of the signal.
/// In brackets: the error term of errors/ that simulates it.
enum class NoiseTerm : std::size_t {
  white,             ///< N, angle or velocity random walk, u/√Hz (WhiteNoise)
  random_walk,       ///< K, rate random walk, u/s/√Hz (RandomWalk)
  bias_instability,  ///< B, flicker noise, u; a data sheet's in-run stability is 0.664·B (BiasInstability)
  quantization,      ///< Q, white noise of the integral, u·s (QuantizationNoise)
  rate_ramp,         ///< R, drift, u/s (RateRamp)
  gauss_markov,      ///< G, standard deviation of a bias with a finite correlation time, u
  warm_up            ///< W, height A of a drift A·exp(−t/T) that settles, u
};

namespace detail {

/// The five terms of IEEE Std 952. Each has a single coefficient.
inline constexpr std::array<NoiseTerm, 5> standard_terms{NoiseTerm::white, NoiseTerm::random_walk,
                                                         NoiseTerm::bias_instability, NoiseTerm::quantization,
                                                         NoiseTerm::rate_ramp};

}  // namespace detail

inline constexpr std::array<NoiseTerm, 7> noise_terms{
    NoiseTerm::white,     NoiseTerm::random_walk,  NoiseTerm::bias_instability, NoiseTerm::quantization,
    NoiseTerm::rate_ramp, NoiseTerm::gauss_markov, NoiseTerm::warm_up};

/// The symbol of a term: N, K, B, Q, R, G or W.
[[nodiscard]] constexpr std::string_view symbol(NoiseTerm term) {
  return std::array<std::string_view, 7>{"N", "K", "B", "Q", "R", "G", "W"}[static_cast<std::size_t>(term)];
}

[[nodiscard]] constexpr std::string_view name(NoiseTerm term) {
  return std::array<std::string_view, 7>{"white noise", "random walk",       "bias instability", "quantization noise",
                                         "rate ramp",   "Gauss-Markov bias", "warm-up"}[static_cast<std::size_t>(term)];
}

/// A set of noise terms, such as those of a model.
class NoiseTerms {
 public:
  constexpr NoiseTerms() = default;
  constexpr NoiseTerms(std::initializer_list<NoiseTerm> terms) {
    for (const NoiseTerm term : terms) bits_ |= bit(term);
  }
  static constexpr unsigned sets = 128;
  [[nodiscard]] static constexpr NoiseTerms all() { return numbered(sets - 1); }
  /// The set with this number. The numbers 0 … sets − 1 stand for all different sets.
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

/// Allan variance [u²] of a standard term with coefficient 1 at averaging time tau [s]: 1/tau, tau/3, 2 ln 2/π, 3/tau²,
/// tau²/2, in the order of standard_terms. Source: IEEE Std 952-1997, C.1. Zero for Gauss–Markov and warm-up, which
/// also need a time.
template <typename Scalar>
[[nodiscard]] Scalar allan_variance(NoiseTerm term, const Scalar& tau) {
  switch (term) {
    case NoiseTerm::white:
      return 1 / tau;
    case NoiseTerm::random_walk:
      return tau / 3;
    case NoiseTerm::bias_instability: {
      constexpr auto floor = splinertia::detail::allan_floor_over_bias_instability<Scalar>();
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

namespace detail {

/// Allan variance [u²] of a Gauss–Markov bias with standard deviation 1 u and this correlation time [s], at averaging
/// time tau [s]: 2/x·(1 − (3 − 4e^(−x) + e^(−2x))/(2x)) with x = tau/correlation_time. Source: IEEE Std 952-1997,
/// C.1.5, which uses the density of the driving noise instead. Below x = 1/100 the series 2x/3·(1 − 3x/4) is used, with
/// a relative error below 4e-5.
template <typename Scalar>
[[nodiscard]] Scalar gauss_markov_allan_variance(const Scalar& tau, const Scalar& correlation_time) {
  const Scalar x = tau / correlation_time;
  if (x < Scalar(1) / 100) return 2 * x / 3 * (1 - 3 * x / 4);
  // 3 − 4e^(−x) + e^(−2x) = 2(1 − e^(−x)) + (1 − e^(−x))², which does not cancel.
  const Scalar lost = -std::expm1(-x);
  return 2 / x * (1 - (2 * lost + lost * lost) / (2 * x));
}

/// Allan variance [u²] of a drift exp(−t/decay_time) u, t = 0 … duration, at averaging time tau [s], averaged over all
/// positions in the log where two averages fit: half the square of (1 − e^(−x))²/x, x = tau/decay_time, times the mean
/// of e^(−2t/decay_time) over these positions.
template <typename Scalar>
[[nodiscard]] Scalar warm_up_allan_variance(const Scalar& tau, const Scalar& decay_time, const Scalar& duration) {
  const Scalar x = tau / decay_time, lost = -std::expm1(-x);
  const Scalar difference = lost * lost / x;
  const Scalar places = 2 * (std::max)(duration - 2 * tau, Scalar(0)) / decay_time;
  const Scalar mean = places > 0 ? -std::expm1(-places) / places : Scalar(1);
  return difference * difference / 2 * mean;
}

}  // namespace detail

}  // namespace splinertia::allan
