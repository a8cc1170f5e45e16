// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <splinertia/allan/detail/band_selection.hpp>
#include <splinertia/allan/detail/fit_bands.hpp>
#include <splinertia/allan/detail/model/model_estimates.hpp>
#include <splinertia/allan/detail/model/model_selection.hpp>
#include <splinertia/allan/detail/pooled_spectrum.hpp>
#include <splinertia/allan/difference_spectrum.hpp>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia::allan {

template <typename Scalar>
struct IdentifyOptions {
  Scalar confidence = Scalar(95) / 100;  ///< of Estimate::interval
  NoiseTerms candidates = NoiseTerms::all();
  /// Frequencies above this one [Hz] are not used. Zero: all up to rate/2.
  Scalar highest_frequency = 0;
  std::vector<Interval<Scalar>> excluded{};  ///< frequency bands [Hz] that are not used
  /// Also leave out bands where the power is not that of noise terms: lines, resonances, the range above a low-pass
  /// filter.
  bool exclude_misfits = true;
};

namespace detail {

/// The steps of identify() below: identification of a model by maximum likelihood.
template <typename Scalar>
class Identification {
 public:
  Identification(std::vector<DifferenceSpectrum<Scalar>> spectra, const IdentifyOptions<Scalar>& options)
      : options_(checked(options)),
        spectra_(std::move(spectra)),
        spectrum_(spectra_),
        highest_(options.highest_frequency > 0 ? (std::min)(options.highest_frequency, spectrum_.rate() / 2)
                                               : spectrum_.rate() / 2),
        bands_(spectrum_, highest_, options.excluded) {
    require_enough();
    select();
    if (!options.exclude_misfits || fits()) return;
    bands_.leave_out_misfits(NoiseTerms{NoiseTerm::white, NoiseTerm::random_walk, NoiseTerm::bias_instability,
                                        NoiseTerm::quantization, NoiseTerm::rate_ramp, NoiseTerm::gauss_markov});
    constexpr int most_rounds = 12;
    for (int round = 0; round < most_rounds && enough(); ++round) {
      select();
      if (std::abs(worst_.off) < BandSelection<Scalar>::most_off) return;
      bands_.leave_out(worst_);
    }
    if (enough()) return;
    // No part of the spectrum is like these terms: report all of it, and that it does not fit.
    bands_.reset();
    select();
  }

  // Its members refer to one another.
  Identification(const Identification&) = delete;
  Identification& operator=(const Identification&) = delete;

  [[nodiscard]] NoiseEstimates<Scalar> estimates() const {
    NoiseEstimates<Scalar> result;
    result.duration = spectrum_.duration();
    result.fits = fits();
    result.fit_probability = probability_;
    result.agreement_probability = agreement_probability();
    for (const auto& octave : octaves_) result.bands.push_back(octave.fit);
    const std::size_t end = bands_.used_end();
    const bool all = end == spectrum_.bins().size() || spectrum_.bins()[end].frequency > highest_;
    result.highest_frequency = all ? highest_ : spectrum_.bins()[end - 1].frequency;
    const FitBands<Scalar> fit(*fit_, described_->result, has_trend(described_->terms), Scalar(0));
    for (const auto& [begin, past] : bands_.gaps()) result.excluded.push_back(fit.band(begin, past));
    result.spectrum = fit.spectrum(bands_.included());
    ModelEstimates<Scalar>(*selection_, options_.confidence, candidates()).write_to(result);
    return result;
  }

 private:
  using Fit = SpectralFit<Scalar>;
  using Selection = ModelSelection<Scalar>;
  using Model = typename Selection::Model;
  using Result = typename Fit::Result;

  [[nodiscard]] static const IdentifyOptions<Scalar>& checked(const IdentifyOptions<Scalar>& options) {
    splinertia::detail::require(options.confidence > 0 && options.confidence < 1, "identify", "confidence",
                                options.confidence, "a number between 0 and 1");
    splinertia::detail::require_non_negative("identify", "highest_frequency", options.highest_frequency);
    for (const auto& band : options.excluded) {
      splinertia::detail::require_non_negative("identify", "excluded band", band.lower);
      splinertia::detail::require(band.upper > band.lower, "identify", "upper end of an excluded band", band.upper,
                                  "more than its lower end");
    }
    NoiseTerms alone = options.candidates;
    for (const NoiseTerm term : {NoiseTerm::rate_ramp, NoiseTerm::gauss_markov, NoiseTerm::warm_up}) {
      alone = alone.without(term);
    }
    if (alone.empty()) {
      splinertia::detail::refuse<std::invalid_argument>(
          "identify: candidates, expected at least one of white noise, random walk, bias instability and "
          "quantization noise");
    }
    return options;
  }

  void require_enough() const {
    const Scalar first = spectrum_.bins().front().frequency;
    if (options_.highest_frequency > 0 && !(options_.highest_frequency > 8 * first)) {
      splinertia::detail::refuse<std::invalid_argument>(
          "identify: highest_frequency is ", options_.highest_frequency,
          " Hz, expected more than eight times the lowest frequency of the spectrum, ", first, " Hz");
    }
    if (!options_.excluded.empty() && !enough()) {
      splinertia::detail::refuse<std::invalid_argument>("identify: the excluded bands leave ", bands_.count(), " of ",
                                                        spectrum_.bins().size(),
                                                        " bins of the spectrum, expected at least ", fewest);
    }
  }

  /// Whether enough bins are left for an identification.
  static constexpr std::size_t fewest = 64;
  [[nodiscard]] bool enough() const { return bands_.count() >= (std::min)(fewest, spectrum_.bins().size()); }

  /// Without the upper end of the spectrum, quantization noise cannot be told from other noise that rises with
  /// frequency. It is then a candidate only if white noise, walk and flicker are not.
  [[nodiscard]] NoiseTerms candidates() const {
    using enum NoiseTerm;
    const NoiseTerms terms = options_.candidates;
    const bool upper_end = bands_.used_end() == spectrum_.bins().size();
    const bool others = terms.has(white) || terms.has(random_walk) || terms.has(bias_instability);
    return upper_end || !others ? terms : terms.without(quantization);
  }

  void select() {
    fit_.emplace(spectrum_, bands_.included());
    selection_.emplace(*fit_, candidates());
    described_ = selection_->descriptions().front();
    const FitBands<Scalar> bands(*fit_, described_->result, has_trend(described_->terms),
                                 BandSelection<Scalar>::tolerance);
    worst_ = bands.worst(bands_.included());
    octaves_ = bands.octaves(bands_.included());
    Scalar parameters = 0;
    for (const NoiseTerm term : noise_terms) parameters += described_->terms.has(term) ? 1 : 0;
    probability_ = FitBands<Scalar>::probability(octaves_, parameters, BandSelection<Scalar>::tolerance);
  }

  /// False for deviations that chance causes in at most one log of a thousand.
  [[nodiscard]] bool fits() const {
    return probability_ > Scalar(1) / 1000 && std::abs(worst_.off) < BandSelection<Scalar>::most_off;
  }

  /// p-value of common coefficients against separate ones for each axis: the likelihood ratio is chi-square (Wilks).
  [[nodiscard]] Scalar agreement_probability() const {
    if (spectra_.size() == 1) return Scalar(1);
    const Model& best = selection_->best();
    Scalar together = best.result.objective, apart = 0;
    for (const auto& spectrum : spectra_) {
      const PooledSpectrum<Scalar> own(std::span(&spectrum, 1));
      const Fit fit(own, bands_.included());
      apart += ModelLikelihood<Scalar>(fit).maximise(best.terms).objective;
      // Converts from the unit of the axis to the common one.
      Scalar count = 0;
      for (std::size_t i = 0; i < own.bins().size(); ++i)
        count += bands_.included()[i] ? own.bins()[i].count : Scalar(0);
      apart += 2 * count * (std::log(own.unit()) - std::log(spectrum_.unit()));
    }
    Scalar parameters = 0;
    for (const NoiseTerm term : Fit::spectral_terms) parameters += best.terms.has(term) ? 1 : 0;
    if (best.terms.has(NoiseTerm::gauss_markov)) parameters += 1;
    if (best.terms.has(NoiseTerm::warm_up)) parameters += 1;
    if (parameters == 0) return Scalar(1);
    return chi_square_upper_tail((std::max)(together - apart, Scalar(0)),
                                 parameters * static_cast<Scalar>(spectra_.size() - 1));
  }

  IdentifyOptions<Scalar> options_;
  std::vector<DifferenceSpectrum<Scalar>> spectra_;
  PooledSpectrum<Scalar> spectrum_;
  Scalar highest_;
  BandSelection<Scalar> bands_;
  std::optional<Fit> fit_;
  std::optional<Selection> selection_;
  std::optional<Model> described_;  ///< the reported model: the first of the descriptions
  typename FitBands<Scalar>::Window worst_{};
  std::vector<typename FitBands<Scalar>::Octave> octaves_;
  Scalar probability_{};
};

}  // namespace detail

/// Estimates the noise of a static log: N, K, B, Q, R, a Gauss–Markov bias and a warm-up with intervals, or upper
/// limits of terms that are not detected. Maximises the likelihood of the signal's differences, which is exact for
/// white noise and random walk. The intervals are profile-likelihood intervals over all equally good descriptions of
/// the log. Throws std::invalid_argument for options out of their range.
template <typename Scalar>
[[nodiscard]] NoiseEstimates<Scalar> identify(const IntegratedSignal<Scalar>& signal,
                                              const IdentifyOptions<Scalar>& options = {}) {
  return detail::Identification<Scalar>({DifferenceSpectrum<Scalar>(signal)}, options).estimates();
}

/// The same for a rate signal at `rate` Hz. Also throws what IntegratedSignal throws.
template <Signal S>
[[nodiscard]] NoiseEstimates<detail::ScalarOfSignal<S>> identify(
    const S& signal, detail::ScalarOfSignal<S> rate, const IdentifyOptions<detail::ScalarOfSignal<S>>& options = {}) {
  return identify(IntegratedSignal<detail::ScalarOfSignal<S>>(signal, rate), options);
}

/// One estimate for all axes of a sensor that have the same noise, from their pooled spectra. Each axis has its own
/// ramp or warm-up; R and W are root mean squares over the axes. Throws std::invalid_argument for no axes, axes that
/// differ in rate or number of samples, and options out of their range.
template <typename Scalar>
[[nodiscard]] NoiseEstimates<Scalar> identify_pooled(const std::vector<DifferenceSpectrum<Scalar>>& axes,
                                                     const IdentifyOptions<Scalar>& options = {}) {
  if (axes.empty()) splinertia::detail::refuse<std::invalid_argument>("identify_pooled: no axes");
  for (const auto& axis : axes) {
    if (axis.rate() != axes[0].rate() || axis.samples() != axes[0].samples()) {
      splinertia::detail::refuse<std::invalid_argument>("identify_pooled: an axis has ", axis.samples(), " samples at ",
                                                        axis.rate(), " Hz, expected ", axes[0].samples(), " at ",
                                                        axes[0].rate(), " Hz");
    }
  }
  return detail::Identification<Scalar>(axes, options).estimates();
}

}  // namespace splinertia::allan
