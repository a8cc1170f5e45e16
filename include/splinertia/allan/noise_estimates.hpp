// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/allan/interval.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <vector>

namespace splinertia::allan {

/// An estimated coefficient of a noise term, in the signal's unit and seconds (see NoiseTerm). Densities are those of
/// continuous time.
template <typename Scalar>
struct Estimate {
  /// The middle of the one-sigma interval. For a walk known to 30 % it is 2 % too low on average, the most likely value
  /// 6 %, and it scatters less. R and W, and fit_curve(), give the most likely value. Do not use the value of a term
  /// that is neither detected nor possible: use interval.upper.
  Scalar value{};
  /// At the requested confidence. If the term is not detected, lower is zero and upper is its limit.
  Interval<Scalar> interval{};
  Interval<Scalar> one_sigma{};  ///< at 68.27 %
  /// Every description of the log has the term. False detections: in at most 1.5 % of logs, whatever else they contain
  /// (measured, docs/performance.md). Exceptions: logs from which bands were left out, and white noise in a log of
  /// quantization noise alone, whose two ends look like N = 2Q/√duration.
  bool detected = false;
  /// Some descriptions have the term and others do not, and this log cannot tell them apart. `value` is then from the
  /// best description that has it.
  bool possible = false;

  /// Half the one-sigma interval.
  [[nodiscard]] Scalar standard_error() const { return (one_sigma.upper - one_sigma.lower) / 2; }
};

/// The estimate of a term with a time besides its coefficient. All members are zero if the term is neither detected nor
/// possible: an upper limit would depend on the unknown time.
template <typename Scalar>
struct TimedEstimate : Estimate<Scalar> {
  Scalar time{};                     ///< s
  Interval<Scalar> time_interval{};  ///< at the requested confidence, within the range that the log can show
};

/// The power of a log over the power of the identified model, in a band of frequencies.
template <typename Scalar>
struct BandFit {
  Interval<Scalar> frequencies{};  ///< Hz
  Scalar ratio{};                  ///< observed over expected
  Scalar standard_error{};         ///< of the ratio, if the model is true
};

namespace detail {

/// A point of the spectrum of a log, with the power that the best description expects there.
template <typename Scalar>
struct SpectrumPoint {
  Scalar frequency{};  ///< Hz
  Scalar density{};    ///< two-sided like N, unit/√Hz, with the estimated trend removed
  Scalar expected{};   ///< likewise
  Scalar count{};      ///< degrees of freedom of the square of `density`
  bool used{};         ///< false in bands that were left out
};

}  // namespace detail

/// One model that describes a log.
template <typename Scalar>
struct Description {
  NoiseTerms terms;
  std::array<Scalar, noise_terms.size()> values{};  ///< most likely coefficients by NoiseTerm, zero if absent
  Scalar correlation_time{};                        ///< of Gauss–Markov, s; zero if absent
  Scalar decay_time{};                              ///< of a warm-up, s; zero if absent
  Scalar cost{};  ///< −2·log-likelihood + 3 per parameter (9 per trend slope), less that of the cheapest model

  [[nodiscard]] Scalar value(NoiseTerm term) const { return values[static_cast<std::size_t>(term)]; }
};

/// The noise of a static log.
template <typename Scalar>
struct NoiseEstimates {
  Estimate<Scalar> N;       ///< white noise, unit/√Hz
  Estimate<Scalar> K;       ///< random walk, unit/s/√Hz
  Estimate<Scalar> B;       ///< bias instability, unit; a data sheet's is 0.664·B (allan_floor)
  Estimate<Scalar> Q;       ///< quantization noise, unit·s
  Estimate<Scalar> R;       ///< rate ramp, unit/s, magnitude
  TimedEstimate<Scalar> G;  ///< Gauss–Markov: standard deviation, unit, and correlation time
  TimedEstimate<Scalar> W;  ///< warm-up: magnitude of its height, unit, and decay time

  /// The descriptions that fit the log equally well, as far as it can tell, cheapest first. There are several if the
  /// log is too short, or its slow noise too weak, to tell the kind of slow noise.
  std::vector<Description<Scalar>> descriptions;

  /// A deterministic drift describes the log as well as slow noise does: a smooth one, as from temperature, or steps at
  /// `step_times` [s]. Then no walk, bias instability or Gauss–Markov bias is detected.
  bool may_be_drift = false;
  std::vector<Scalar> step_times;
  NoiseTerms considered;  ///< the candidates in the end; without Q if the upper end of the spectrum was left out
  /// A Gauss–Markov bias with a correlation time above this [s] describes the log as well as the detected random walk,
  /// at 95 % confidence: the walk may be bounded. Zero if no walk was detected.
  Scalar least_correlation_time{};
  Scalar duration{};           ///< of the log, s
  Scalar highest_frequency{};  ///< up to which the log was used, Hz; rate/2 if the model holds that far
  /// Bands left out below highest_frequency: lines, resonances and IdentifyOptions::excluded. Lowest first. The ratio
  /// is the observed power over that of the model.
  std::vector<BandFit<Scalar>> excluded;
  /// The power agrees with the model outside the excluded bands. If false, only N can be detected and intervals do not
  /// hold.
  bool fits = false;
  Scalar fit_probability{};  ///< p-value of the deviations of the octaves from the model, in both directions
  /// Of several axes: p-value of the hypothesis that they have the same noise. Below 0.01 they do not.
  Scalar agreement_probability = 1;
  std::vector<BandFit<Scalar>> bands;  ///< octaves, highest first; empty from fit_curve()

  [[nodiscard]] const Estimate<Scalar>& operator[](NoiseTerm term) const {
    const std::array<const Estimate<Scalar>*, noise_terms.size()> all{&N, &K, &B, &Q, &R, &G, &W};
    return *all[static_cast<std::size_t>(term)];
  }
  [[nodiscard]] Estimate<Scalar>& operator[](NoiseTerm term) {
    const std::array<Estimate<Scalar>*, noise_terms.size()> all{&N, &K, &B, &Q, &R, &G, &W};
    return *all[static_cast<std::size_t>(term)];
  }

  std::vector<detail::SpectrumPoint<Scalar>>
      spectrum;  ///< about eight per octave, lowest first; empty from fit_curve()

  /// The Allan deviation of the best description at averaging time tau [s].
  [[nodiscard]] Scalar deviation(const Scalar& tau) const {
    Scalar variance = 0;
    if (descriptions.empty()) return variance;
    const Description<Scalar>& best = descriptions.front();
    for (const NoiseTerm term : detail::standard_terms) {
      variance += best.value(term) * best.value(term) * allan_variance(term, tau);
    }
    const Scalar bias = best.value(NoiseTerm::gauss_markov), drift = best.value(NoiseTerm::warm_up);
    if (bias > 0) variance += bias * bias * detail::gauss_markov_allan_variance(tau, best.correlation_time);
    if (drift > 0) variance += drift * drift * detail::warm_up_allan_variance(tau, best.decay_time, duration);
    return std::sqrt(variance);
  }
};

}  // namespace splinertia::allan
