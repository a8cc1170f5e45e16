// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/allan/interval.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <vector>

namespace splinertia::allan {

/// A coefficient of a noise term, in the signal's unit and seconds (NoiseTerm), densities of continuous time.
template <typename Scalar>
struct Estimate {
  /// The middle of the one-sigma interval. The most likely value of a walk known to 30 % is 6 % too low on average,
  /// this 2 %, and scatters less. Of a term that is neither detected nor possible it says nothing: use interval.upper.
  Scalar value{};
  /// At the confidence that was asked for; lower is zero for what is not detected, upper its limit.
  Interval<Scalar> interval{};
  Interval<Scalar> one_sigma{};  ///< at 68.27 %
  /// Every description of the log has it. It is by chance in at most 1.5 % of logs of whatever else there is (measured,
  /// docs/performance.md), but beside bands that were left out; and but for white noise beside
  /// quantization noise alone, whose ends look like N = 2Q/√duration.
  bool detected = false;
  /// Some descriptions have it and others, which this log cannot tell from them, do not: `value` is what it is in the
  /// best of those that have it.
  bool possible = false;

  /// Half the one-sigma interval.
  [[nodiscard]] Scalar standard_error() const { return (one_sigma.upper - one_sigma.lower) / 2; }
};

/// A term that has a time beside its coefficient. Of one that is neither detected nor possible all is zero: how large
/// it could be depends on a time that nobody knows.
template <typename Scalar>
struct TimedEstimate : Estimate<Scalar> {
  Scalar time{};                     ///< s
  Interval<Scalar> time_interval{};  ///< at the confidence that was asked for, within what the log can show
};

/// How the power of a log compares with what was identified, in a band of frequencies.
template <typename Scalar>
struct BandFit {
  Interval<Scalar> frequencies{};  ///< Hz
  Scalar ratio{};                  ///< observed over expected
  Scalar standard_error{};         ///< of the ratio, if the model is true
};

/// What the spectrum of a log is at a frequency, and what the best description has there.
template <typename Scalar>
struct SpectrumPoint {
  Scalar frequency{};  ///< Hz
  Scalar density{};    ///< two-sided, as N is, unit/√Hz; without the trend that was found
  Scalar expected{};   ///< likewise
  Scalar count{};      ///< degrees of freedom of the square of `density`
  bool used{};         ///< false where bands were left out
};

/// One way to describe a log.
template <typename Scalar>
struct Description {
  NoiseTerms terms;
  std::array<Scalar, noise_terms.size()> values{};  ///< most likely coefficients, by NoiseTerm; zero if it has not
  Scalar correlation_time{};                        ///< of Gauss–Markov, s; zero if it has none
  Scalar decay_time{};                              ///< of a warm-up, s; zero if it has none
  Scalar cost{};  ///< −2·log-likelihood and 3 for each parameter, more than the cheapest has

  [[nodiscard]] Scalar value(NoiseTerm term) const { return values[static_cast<std::size_t>(term)]; }
};

/// What a static log says about its noise.
template <typename Scalar>
struct NoiseEstimates {
  Estimate<Scalar> N;       ///< white noise, unit/√Hz
  Estimate<Scalar> K;       ///< random walk, unit/s/√Hz
  Estimate<Scalar> B;       ///< bias instability, unit; a data sheet's is 0.664·B (allan_floor)
  Estimate<Scalar> Q;       ///< quantization noise, unit·s
  Estimate<Scalar> R;       ///< rate ramp, unit/s, without its sign
  TimedEstimate<Scalar> G;  ///< Gauss–Markov: standard deviation, unit, and correlation time
  TimedEstimate<Scalar> W;  ///< warm-up: height without its sign, unit, and decay time

  /// What describes the log equally well, as far as it can tell: the cheapest first. Several if the log is too short,
  /// or its slow noise too weak, to tell what kind it is of.
  std::vector<Description<Scalar>> descriptions;

  /// The slow noise may be no noise: a smooth drift, as of a temperature, or steps at `step_times` [s] describe the log
  /// as well. No walk, bias instability or Gauss–Markov bias is detected then.
  bool may_be_drift = false;
  std::vector<Scalar> step_times;
  NoiseTerms considered;  ///< terms that were candidates in the end: Q is none if the upper end was left out
  /// A Gauss–Markov bias with a longer correlation time than this [s] describes the log as well as the walk that was
  /// detected, at 95 % confidence: the walk may be bounded. Zero if none was detected.
  Scalar least_correlation_time{};
  Scalar duration{};           ///< of the log, s
  Scalar highest_frequency{};  ///< up to which the log was used, Hz; rate/2 if the model holds that far
  /// What was left out below that: lines, resonances, what was asked for. From the lowest up, with the power that is
  /// there over what the model has.
  std::vector<BandFit<Scalar>> excluded;
  /// The power agrees with the model in all that is not left out. If it does not, nothing but N is called detected, and
  /// intervals do not hold.
  bool fits = false;
  Scalar fit_probability{};  ///< that chance makes octaves deviate from the model, up and down, as much as these do
  /// Of several axes together: that chance makes axes that share their noise differ as much as these do. Below a
  /// hundredth, they have no common noise to speak of.
  Scalar agreement_probability = 1;
  std::vector<BandFit<Scalar>> bands;  ///< octaves, from the highest down; none of fit_curve(), which cannot know

  [[nodiscard]] const Estimate<Scalar>& operator[](NoiseTerm term) const {
    const std::array<const Estimate<Scalar>*, noise_terms.size()> all{&N, &K, &B, &Q, &R, &G, &W};
    return *all[static_cast<std::size_t>(term)];
  }
  [[nodiscard]] Estimate<Scalar>& operator[](NoiseTerm term) {
    const std::array<Estimate<Scalar>*, noise_terms.size()> all{&N, &K, &B, &Q, &R, &G, &W};
    return *all[static_cast<std::size_t>(term)];
  }

  std::vector<SpectrumPoint<Scalar>> spectrum;  ///< from the lowest frequency up, about eight an octave; likewise

  /// What the terms of the best description add up to at averaging time tau [s].
  [[nodiscard]] Scalar deviation(const Scalar& tau) const {
    Scalar variance = 0;
    if (descriptions.empty()) return variance;
    const Description<Scalar>& best = descriptions.front();
    for (const NoiseTerm term : standard_terms) {
      variance += best.value(term) * best.value(term) * allan_variance(term, tau);
    }
    const Scalar bias = best.value(NoiseTerm::gauss_markov), drift = best.value(NoiseTerm::warm_up);
    if (bias > 0) variance += bias * bias * gauss_markov_allan_variance(tau, best.correlation_time);
    if (drift > 0) variance += drift * drift * warm_up_allan_variance(tau, best.decay_time, duration);
    return std::sqrt(variance);
  }
};

}  // namespace splinertia::allan
