// SPDX-License-Identifier: MIT
/// A deviation as a function of averaging time, with confidence intervals:
///
///   auto curve = allan::overlapping(signal, 200.0);
///   curve.points[3].tau, .deviation, .interval.lower, .interval.upper
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <splinertia/allan/averaging_factors.hpp>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/degrees_of_freedom.hpp>
#include <splinertia/allan/detail/total_degrees_of_freedom.hpp>
#include <splinertia/allan/deviations.hpp>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/interval.hpp>
#include <splinertia/allan/noise_type.hpp>
#include <string>
#include <vector>

namespace splinertia::allan {

template <typename Scalar>
struct DeviationPoint {
  std::int64_t factor;        ///< m, samples per average
  Scalar tau;                 ///< averaging time m/rate, s
  std::int64_t terms;         ///< number of squared differences averaged
  Scalar deviation;           ///< unit of the signal; TDEV: times s
  int alpha;                  ///< power law of the spectrum near this tau (noise_type)
  Scalar degrees_of_freedom;  ///< equivalent chi-square degrees of freedom of deviation²
  Interval<Scalar> interval;  ///< of the true deviation
};

template <typename Scalar>
struct DeviationCurve {
  std::string name;      ///< adev, oadev …
  Scalar rate;           ///< Hz
  std::int64_t samples;  ///< of the rate signal
  Scalar mean;           ///< of the rate signal, in its unit
  Scalar confidence;     ///< of the intervals
  std::vector<DeviationPoint<Scalar>> points;
};

template <typename Scalar>
struct DeviationOptions {
  AveragingFactors factors = AveragingFactors::logarithmic();
  Scalar confidence = detail::one_sigma<Scalar>;
  std::optional<int> alpha{};  ///< use this power law for all points instead of identifying it
  /// The default has the published degrees of freedom (Greenhall and Riley 2003, SP 1065, Stable32), so that intervals
  /// are comparable with those of other tools. PhaseModel::sampled is exact for the samples of an IMU; it differs by up
  /// to 17 % below m = 30.
  PhaseModel phase_model = PhaseModel::greenhall_riley;
};

/// The equivalent degrees of freedom of a deviation at averaging factor m in a log of n samples.
template <Deviation D>
[[nodiscard]] double degrees_of_freedom(int alpha, std::int64_t m, std::int64_t n, PhaseModel model) {
  if constexpr (std::same_as<D, TotalDeviation>) {
    return detail::total_degrees_of_freedom(alpha, m, n, model);
  } else {
    return detail::equivalent_degrees_of_freedom({D::differences, D::modified}, alpha, m, D::terms(n, m),
                                                 D::overlapping ? 1 : m, model);
  }
}

/// The lowest alpha for which D converges. The degrees of freedom use it when a lower alpha was identified, which is
/// more often a ramp or a random walk than such noise: one walk in seven looks like it.
template <Deviation D>
inline constexpr int steepest_power_law = 2 - 2 * D::differences;

/// The curve of one kind of deviation (deviations.hpp) of a signal. Throws std::invalid_argument for a factor that is
/// outside the data and a confidence not between 0 and 1.
template <Deviation D, typename Scalar>
[[nodiscard]] DeviationCurve<Scalar> curve(const IntegratedSignal<Scalar>& signal,
                                           const DeviationOptions<Scalar>& options = {}) {
  const std::int64_t n = signal.samples();
  const auto factors = options.factors.up_to(D::largest_factor(n));
  const auto values = deviations<D>(signal, factors);
  DeviationCurve<Scalar> result{std::string(D::name), signal.rate(), n, signal.mean(), options.confidence, {}};
  result.points.reserve(factors.size());
  for (std::size_t j = 0; j < factors.size(); ++j) {
    const std::int64_t m = factors[j];
    const int alpha = options.alpha ? *options.alpha : noise_type(signal, m);
    const int converging = options.alpha ? alpha : (std::max)(alpha, steepest_power_law<D>);
    const auto freedom = static_cast<Scalar>(degrees_of_freedom<D>(converging, m, n, options.phase_model));
    result.points.push_back({m, static_cast<Scalar>(m) / signal.rate(), D::terms(n, m), values[j], alpha, freedom,
                             detail::deviation_interval(values[j], freedom, options.confidence)});
  }
  return result;
}

/// The same for a rate signal at `rate` Hz. Also throws what IntegratedSignal throws.
template <Deviation D, Signal S>
[[nodiscard]] DeviationCurve<detail::ScalarOfSignal<S>> curve(
    const S& signal, detail::ScalarOfSignal<S> rate, const DeviationOptions<detail::ScalarOfSignal<S>>& options = {}) {
  return curve<D>(IntegratedSignal<detail::ScalarOfSignal<S>>(signal, rate), options);
}

/// The curve of the overlapping Allan deviation, the recommended one.
template <Signal S>
[[nodiscard]] DeviationCurve<detail::ScalarOfSignal<S>> overlapping(
    const S& signal, detail::ScalarOfSignal<S> rate, const DeviationOptions<detail::ScalarOfSignal<S>>& options = {}) {
  return curve<OverlappingAllanDeviation>(signal, rate, options);
}

}  // namespace splinertia::allan
