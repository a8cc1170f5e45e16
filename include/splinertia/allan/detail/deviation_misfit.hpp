// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/detail/chi_square_deviation.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <vector>

namespace splinertia::allan::detail {

/// The power law of the term with the largest Allan variance in a model at averaging time tau [s].
template <typename Scalar>
[[nodiscard]] int ruling_power_law(const Description<Scalar>& description, const Scalar& tau, const Scalar& duration) {
  int alpha = 0;
  Scalar largest = 0;
  const auto compare = [&](Scalar variance, int power_law) {
    if (variance <= largest) return;
    largest = variance;
    alpha = power_law;
  };
  for (const NoiseTerm term : standard_terms) {
    const Scalar value = description.value(term);
    compare(value * value * allan_variance(term, tau), term == NoiseTerm::white              ? 0
                                                       : term == NoiseTerm::bias_instability ? -1
                                                       : term == NoiseTerm::quantization     ? 2
                                                                                             : -2);
  }
  const Scalar bias = description.value(NoiseTerm::gauss_markov), drift = description.value(NoiseTerm::warm_up);
  if (bias > 0) {
    const Scalar time = description.correlation_time;
    compare(bias * bias * gauss_markov_allan_variance(tau, time), tau < time ? -2 : 0);
  }
  if (drift > 0) compare(drift * drift * warm_up_allan_variance(tau, description.decay_time, duration), -2);
  return alpha;
}

/// A range of averaging times at which the measured deviation disagrees with a model.
template <typename Scalar>
struct DeviationMisfit {
  Scalar shortest{}, longest{};  ///< averaging times, s
  Scalar worst{};                ///< averaging time of the most significant disagreement, s
  Scalar ratio{};                ///< measured over model deviation at `worst`
};

/// The Allan variance [u²] that a description has at m samples in addition to its continuous-time value at tau. Random
/// walk and Gauss–Markov bias are constant over a sampling interval, which gives K²τ/3·(1 + 1/(2m²)).
template <typename Scalar>
[[nodiscard]] Scalar sampled_variance(const Description<Scalar>& description, std::int64_t m, const Scalar& tau) {
  const Scalar walk = description.value(NoiseTerm::random_walk), bias = description.value(NoiseTerm::gauss_markov);
  const Scalar square = walk * walk + (bias > 0 ? 2 * bias * bias / description.correlation_time : Scalar(0));
  return square * tau / (6 * static_cast<Scalar>(m) * static_cast<Scalar>(m));
}

/// Comparison of a point of an overlapping Allan deviation curve with the best description.
template <typename Scalar>
struct DeviationComparison {
  Scalar ratio{};  ///< measured over model
  Scalar off{};    ///< standard normal if the model is true, because ratio² is then a mean of squares
};

/// Compares a point of the curve of a signal with the noise estimates of the same signal.
template <typename Scalar>
[[nodiscard]] DeviationComparison<Scalar> compare_deviation(const DeviationPoint<Scalar>& point, std::int64_t samples,
                                                            const NoiseEstimates<Scalar>& noise) {
  const auto& description = noise.descriptions.front();
  const Scalar model =
      std::hypot(noise.deviation(point.tau), std::sqrt(sampled_variance(description, point.factor, point.tau)));
  if (!(model > 0) || !(point.deviation > 0)) return {Scalar(1), Scalar(0)};
  const int alpha = ruling_power_law(description, point.tau, noise.duration);
  const auto freedom = static_cast<Scalar>(
      degrees_of_freedom<OverlappingAllanDeviation>(alpha, point.factor, samples, PhaseModel::sampled));
  const Scalar ratio = point.deviation / model;
  return {ratio, chi_square_deviation(ratio * ratio, freedom)};
}

/// Where the overlapping Allan deviation of a log differs from that of the best description by more than four standard
/// deviations. Points with the same sign within an octave of each other are one misfit. The curve and the estimates are
/// of the same signal.
template <typename Scalar>
[[nodiscard]] std::vector<DeviationMisfit<Scalar>> deviation_misfits(const DeviationCurve<Scalar>& curve,
                                                                     const NoiseEstimates<Scalar>& noise) {
  constexpr int most_off = 4;
  std::vector<DeviationMisfit<Scalar>> misfits;
  Scalar worst_off = 0, last_sign = 0;
  for (const auto& point : curve.points) {
    const auto [ratio, off] = compare_deviation(point, curve.samples, noise);
    if (std::abs(off) <= most_off) continue;
    const Scalar sign = std::copysign(Scalar(1), off);
    if (sign != last_sign || point.tau > 2 * misfits.back().longest) {
      misfits.push_back({point.tau, point.tau, point.tau, ratio});
      worst_off = 0;
    }
    misfits.back().longest = point.tau;
    if (std::abs(off) > worst_off) {
      worst_off = std::abs(off);
      misfits.back().worst = point.tau;
      misfits.back().ratio = ratio;
    }
    last_sign = sign;
  }
  return misfits;
}

}  // namespace splinertia::allan::detail
