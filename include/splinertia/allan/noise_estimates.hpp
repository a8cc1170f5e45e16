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
  /// this 2 %, and scatters less. Of a term that is not detected it says nothing: use interval.upper.
  Scalar value{};
  /// At the confidence that was asked for; lower is zero for what is not detected, upper its limit.
  Interval<Scalar> interval{};
  Interval<Scalar> one_sigma{};  ///< at 68.27 %
  /// It would be by chance in at most 1 % of logs; but for white noise beside quantization noise alone, whose ends look
  /// like N = 2Q/√duration.
  bool detected = false;

  /// Half the one-sigma interval.
  [[nodiscard]] Scalar standard_error() const { return (one_sigma.upper - one_sigma.lower) / 2; }
};

/// How the power of a log compares with what was identified, in a band of frequencies.
template <typename Scalar>
struct BandFit {
  Interval<Scalar> frequencies{};  ///< Hz
  Scalar ratio{};                  ///< observed over expected
  Scalar standard_error{};         ///< of the ratio, if the model is true
};

/// What a static log says about its noise.
template <typename Scalar>
struct NoiseEstimates {
  Estimate<Scalar> N;  ///< white noise, unit/√Hz
  Estimate<Scalar> K;  ///< random walk, unit/s/√Hz
  Estimate<Scalar> B;  ///< bias instability, unit; a data sheet's is 0.664·B (allan_floor)
  Estimate<Scalar> Q;  ///< quantization noise, unit·s
  Estimate<Scalar> R;  ///< rate ramp, unit/s, without its sign

  Scalar highest_frequency{};  ///< up to which the log was used, Hz; rate/2 if the model holds that far
  bool fits = false;           ///< the power agrees with the model, at least in the octaves that white noise rules
  std::vector<BandFit<Scalar>> bands;  ///< octaves, from the highest down; none of fit_curve(), which cannot know

  [[nodiscard]] const Estimate<Scalar>& operator[](NoiseTerm term) const {
    const std::array<const Estimate<Scalar>*, 5> all{&N, &K, &B, &Q, &R};
    return *all[static_cast<std::size_t>(term)];
  }
  [[nodiscard]] Estimate<Scalar>& operator[](NoiseTerm term) {
    const std::array<Estimate<Scalar>*, 5> all{&N, &K, &B, &Q, &R};
    return *all[static_cast<std::size_t>(term)];
  }

  /// What the detected terms add up to at averaging time tau [s].
  [[nodiscard]] Scalar deviation(const Scalar& tau) const {
    Scalar variance = 0;
    for (const NoiseTerm term : noise_terms) {
      const Estimate<Scalar>& estimate = (*this)[term];
      if (estimate.detected) variance += estimate.value * estimate.value * allan_variance(term, tau);
    }
    return std::sqrt(variance);
  }
};

}  // namespace splinertia::allan
