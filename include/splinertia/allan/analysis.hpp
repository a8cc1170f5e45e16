// SPDX-License-Identifier: MIT
/// The full analysis of a static signal: the curve, the noise terms, and checks that say whether to trust them.
///
///   const auto analysis = allan::analyse(gyro_x, 200.0);
///   if (analysis.adequacy() != allan::Adequacy::inadequate) use(analysis.noise.N.value);
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/detail/deviation_misfit.hpp>
#include <splinertia/allan/identify.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/record/freezes.hpp>
#include <splinertia/allan/record/resolution.hpp>
#include <splinertia/allan/record/saturation.hpp>
#include <splinertia/allan/record/steps.hpp>
#include <splinertia/allan/record/stillness.hpp>
#include <vector>

namespace splinertia::allan {

/// How well a model describes a log.
enum class Adequacy {
  adequate,   ///< the whole log
  partial,    ///< all but the reported bands, steps or knocks; results hold for the rest
  inadequate  ///< it does not: intervals do not hold
};

/// A signal's curve and noise terms, and what is wrong with the signal.
template <typename Scalar>
struct Analysis {
  DeviationCurve<Scalar> curve;  ///< overlapping Allan deviation
  NoiseEstimates<Scalar> noise;
  std::vector<detail::DeviationMisfit<Scalar>> misfits{};  ///< where curve and noise terms disagree
  std::vector<Step> steps{};
  std::vector<SampleSpan> freezes{};
  Stillness stillness{};  ///< in blocks of a second
  Saturation saturation{};
  std::optional<Scalar> resolution{};  ///< unit of the signal; nothing if it does not show
  RoundingEffect rounding = RoundingEffect::none;

  /// Whether the spectrum was used up to its upper end, rate/2.
  [[nodiscard]] bool used_to_the_end() const { return noise.highest_frequency >= curve.rate / 2; }

  [[nodiscard]] Adequacy adequacy() const {
    const bool left_out = !noise.excluded.empty() || !used_to_the_end();
    if (!noise.fits || !freezes.empty() || rounding == RoundingEffect::invalid) return Adequacy::inadequate;
    if (saturation.samples() > 0 || knocks_matter()) return Adequacy::inadequate;
    if (!left_out && steps.empty() && stillness.disturbed == 0)
      return misfits.empty() ? Adequacy::adequate : Adequacy::inadequate;
    return Adequacy::partial;
  }

  /// Whether disturbed blocks may have enough power to change N by more than 1 %. False if there are steps, which
  /// disturb blocks themselves.
  [[nodiscard]] bool knocks_matter() const {
    if (!steps.empty()) return false;
    const auto blocks = static_cast<double>(stillness.blocks), disturbed = static_cast<double>(stillness.disturbed);
    return disturbed * stillness.worst_ratio * stillness.worst_ratio * 50 > blocks;
  }
};

namespace detail {

/// Marks terms as not detected, because their power has another cause. Only the upper limit remains.
template <typename Scalar>
void withhold(NoiseEstimates<Scalar>& noise, NoiseTerms terms) {
  for (const NoiseTerm term : noise_terms) {
    Estimate<Scalar>& estimate = noise[term];
    if (!terms.has(term)) continue;
    estimate.possible = estimate.possible || estimate.detected;
    estimate.detected = false;
    estimate.interval.lower = estimate.one_sigma.lower = Scalar(0);
  }
}

}  // namespace detail

/// Curve, identification and checks of a signal. `signal` and `spectrum` are those of `samples`. In a log with steps or
/// freezes no slow term is detected, because a step looks like a random walk. Throws as identify() and curve() do.
template <Signal S, typename Scalar = detail::ScalarOfSignal<S>>
[[nodiscard]] Analysis<Scalar> analyse(const S& samples, const IntegratedSignal<Scalar>& signal,
                                       const DifferenceSpectrum<Scalar>& spectrum,
                                       const IdentifyOptions<Scalar>& options = {}) {
  Analysis<Scalar> result{.curve = curve<OverlappingAllanDeviation>(signal),
                          .noise = detail::Identification<Scalar>({spectrum}, options).estimates()};
  StepOptions steps{};
  if (const auto resolution = find_resolution(samples)) {
    result.resolution = static_cast<Scalar>(*resolution);
    const Scalar deviation = result.noise.N.value * std::sqrt(signal.rate());
    result.rounding = rounding_effect(*resolution, static_cast<double>(deviation));
    // A mean that crosses from one rounded value to the next is no step.
    if (result.rounding == RoundingEffect::invalid) steps.least_height = *resolution;
  }
  steps.left_out = result.freezes = find_freezes(samples);
  result.steps = find_steps(signal, steps);
  result.saturation = find_saturation(samples);
  // Blocks of a second.
  constexpr std::int64_t least_block = 20, most_block = 1'000'000'000;
  const auto second = static_cast<double>((std::min)(signal.rate(), static_cast<Scalar>(most_block)));
  result.stillness =
      measure_stillness(samples, (std::max)(least_block, static_cast<std::int64_t>(std::llround(second))));
  result.misfits = detail::deviation_misfits(result.curve, result.noise);
  using enum NoiseTerm;
  if (!result.steps.empty() || !result.freezes.empty()) {
    detail::withhold(result.noise, {random_walk, bias_instability, rate_ramp, gauss_markov, warm_up});
  }
  if (result.adequacy() == Adequacy::inadequate) {
    detail::withhold(result.noise, {random_walk, bias_instability, quantization, rate_ramp, gauss_markov, warm_up});
  }
  return result;
}

/// The same for a rate signal at `rate` Hz. Also throws what IntegratedSignal throws.
template <Signal S>
[[nodiscard]] Analysis<detail::ScalarOfSignal<S>> analyse(
    const S& samples, detail::ScalarOfSignal<S> rate, const IdentifyOptions<detail::ScalarOfSignal<S>>& options = {}) {
  const IntegratedSignal<detail::ScalarOfSignal<S>> signal(samples, rate);
  return analyse(samples, signal, DifferenceSpectrum<detail::ScalarOfSignal<S>>(signal), options);
}

}  // namespace splinertia::allan
