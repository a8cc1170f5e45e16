// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <splinertia/allan/band_selection.hpp>
#include <splinertia/allan/difference_spectrum.hpp>
#include <splinertia/allan/fit_bands.hpp>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/model_selection.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/allan/pooled_spectrum.hpp>
#include <splinertia/allan/profile_likelihood.hpp>
#include <splinertia/message.hpp>
#include <splinertia/require.hpp>
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
  std::vector<Interval<Scalar>> excluded{};  ///< bands of frequencies [Hz] that are not used either
  /// Leave out, too, where the power is not that of noise terms: lines, resonances, what is above a low-pass filter.
  bool exclude_misfits = true;
};

/// Identification of a model by its likelihood; what identify() below does step by step.
template <typename Scalar>
class Identification {
 public:
  Identification(std::span<const DifferenceSpectrum<Scalar>> spectra, const IdentifyOptions<Scalar>& options)
      : options_(checked(options)),
        spectra_(spectra),
        spectrum_(spectra),
        highest_(options.highest_frequency > 0 ? std::min(options.highest_frequency, spectrum_.rate() / 2)
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
    // Nothing in it is like these terms: what is said is about all of it, and that it does not fit.
    bands_.reset();
    select();
  }

  [[nodiscard]] NoiseEstimates<Scalar> estimates() const {
    NoiseEstimates<Scalar> result;
    result.duration = spectrum_.duration();
    const auto descriptions = selection_->descriptions();
    for (const Model& model : descriptions) result.descriptions.push_back(described(model));
    for (Description<Scalar>& description : result.descriptions) description.cost -= selection_->best().cost;
    result.fits = fits();
    result.fit_probability = probability_;
    result.agreement_probability = agreement_probability();
    for (const auto& octave : octaves_) result.bands.push_back(octave.fit);
    const std::size_t end = bands_.used_end();
    const bool all = end == spectrum_.bins().size();
    result.highest_frequency = all ? spectrum_.rate() / 2 : std::min(highest_, spectrum_.bins()[end - 1].frequency);
    if (end > 0 && highest_ < spectrum_.rate() / 2 && spectrum_.bins()[end - 1].frequency <= highest_ &&
        (end == spectrum_.bins().size() || spectrum_.bins()[end].frequency > highest_)) {
      result.highest_frequency = highest_;
    }
    const FitBands<Scalar> fit(*fit_, selection_->best().result, has_trend(selection_->best().terms), Scalar(0));
    for (const auto& [begin, past] : bands_.gaps()) result.excluded.push_back(fit.band(begin, past));
    const auto plausible = selection_->plausible_models();
    for (const NoiseTerm term : noise_terms) {
      if (!options_.candidates.has(term)) continue;
      // Slow terms share their power with others in larger models, too, which white and quantization noise hardly do.
      const bool fast = term == NoiseTerm::white || term == NoiseTerm::quantization;
      estimate(term, fast ? descriptions : plausible, result);
    }
    return result;
  }

 private:
  using Fit = SpectralFit<Scalar>;
  using Selection = ModelSelection<Scalar>;
  using Model = typename Selection::Model;
  using Result = typename Fit::Result;

  [[nodiscard]] static const IdentifyOptions<Scalar>& checked(const IdentifyOptions<Scalar>& options) {
    require(options.confidence > 0 && options.confidence < 1, "identify", "confidence", options.confidence,
            "a number between 0 and 1");
    require_non_negative("identify", "highest_frequency", options.highest_frequency);
    for (const auto& band : options.excluded) {
      require_non_negative("identify", "excluded band", band.lower);
      require(band.upper > band.lower, "identify", "upper end of an excluded band", band.upper,
              "more than its lower end");
    }
    if (options.candidates.without(NoiseTerm::rate_ramp).without(NoiseTerm::warm_up).empty()) {
      throw std::invalid_argument("identify: no candidates but a drift, expected a noise term");
    }
    return options;
  }

  void require_enough() const {
    const Scalar first = spectrum_.bins().front().frequency;
    if (options_.highest_frequency > 0 && !(options_.highest_frequency > 8 * first)) {
      throw std::invalid_argument(message("identify: highest_frequency is ", options_.highest_frequency,
                                          " Hz, expected more than eight times the lowest of the log, ", first, " Hz"));
    }
    if (!options_.excluded.empty() && !enough()) {
      throw std::invalid_argument("identify: the excluded bands leave too little, expected four octaves or more");
    }
  }

  /// Enough of a spectrum is left to say something.
  [[nodiscard]] bool enough() const { return bands_.count() >= std::min<std::size_t>(64, spectrum_.bins().size()); }

  [[nodiscard]] static bool has_trend(NoiseTerms terms) {
    return terms.has(NoiseTerm::rate_ramp) || terms.has(NoiseTerm::warm_up);
  }

  /// Quantization noise is what rises towards the upper end of the spectrum: not to be told from anything else that
  /// does if that end is left out.
  [[nodiscard]] NoiseTerms candidates() const {
    const bool upper_end = bands_.used_end() == spectrum_.bins().size();
    return upper_end ? options_.candidates : options_.candidates.without(NoiseTerm::quantization);
  }

  void select() {
    fit_.emplace(spectrum_, bands_.included());
    selection_.emplace(*fit_, candidates());
    const Model& best = selection_->best();
    const FitBands<Scalar> bands(*fit_, best.result, has_trend(best.terms), BandSelection<Scalar>::tolerance);
    worst_ = bands.worst(bands_.included());
    octaves_ = bands.octaves(bands_.included());
    Scalar parameters = 0;
    for (const NoiseTerm term : noise_terms) parameters += best.terms.has(term) ? 1 : 0;
    probability_ = FitBands<Scalar>::probability(octaves_, parameters, BandSelection<Scalar>::tolerance);
  }

  /// Chance deviates as much in one log of a thousand.
  [[nodiscard]] bool fits() const {
    return probability_ > Scalar(1) / 1000 && std::abs(worst_.off) < BandSelection<Scalar>::most_off;
  }

  /// The ratio of the likelihoods with coefficients for each axis and with common ones is chi-square (Wilks).
  [[nodiscard]] Scalar agreement_probability() const {
    if (spectra_.size() == 1) return Scalar(1);
    const Model& best = selection_->best();
    Scalar together = best.result.objective, apart = 0;
    for (const auto& spectrum : spectra_) {
      const PooledSpectrum<Scalar> own(std::span(&spectrum, 1));
      const Fit fit(own, bands_.included());
      apart += ModelLikelihood<Scalar>(fit).maximise(best.terms).objective;
      // Each in its own unit.
      Scalar count = 0;
      for (std::size_t i = 0; i < own.bins().size(); ++i) count += bands_.included()[i] ? own.bins()[i].count : Scalar(0);
      apart += 2 * count * (std::log(own.unit()) - std::log(spectrum_.unit()));
    }
    Scalar parameters = 0;
    for (const NoiseTerm term : Fit::spectral_terms) parameters += best.terms.has(term) ? 1 : 0;
    if (best.terms.has(NoiseTerm::gauss_markov)) parameters += 1;
    if (best.terms.has(NoiseTerm::warm_up)) parameters += 1;
    if (parameters == 0) return Scalar(1);
    return chi_square_upper_tail(std::max(together - apart, Scalar(0)),
                                 parameters * static_cast<Scalar>(spectra_.size() - 1));
  }

  [[nodiscard]] Description<Scalar> described(const Model& model) const {
    Description<Scalar> description{.terms = model.terms, .cost = model.cost};
    const auto set = [&](NoiseTerm term, Scalar value) { description.values[static_cast<std::size_t>(term)] = value; };
    for (const NoiseTerm term : Fit::spectral_terms) {
      const Scalar theta = model.result.theta[Fit::place(term)];
      if (model.terms.has(term) && term != NoiseTerm::gauss_markov) set(term, in_units(term, std::sqrt(theta)));
    }
    if (model.terms.has(NoiseTerm::gauss_markov)) {
      const Scalar time = model.result.times.correlation;
      set(NoiseTerm::gauss_markov, in_units(NoiseTerm::gauss_markov,
                                            std::sqrt(model.result.theta[Fit::place(NoiseTerm::gauss_markov)] * time)));
      description.correlation_time = time;
    }
    if (has_trend(model.terms)) {
      const NoiseTerm term =
          model.terms.has(NoiseTerm::rate_ramp) ? NoiseTerm::rate_ramp : NoiseTerm::warm_up;
      set(term, trend_in_units(term, trend_size(model.result), model.result));
      if (term == NoiseTerm::warm_up) description.decay_time = model.result.times.decay;
    }
    return description;
  }

  /// Root mean square of the slopes of all axes, unit() a sample.
  [[nodiscard]] static Scalar trend_size(const Result& result) {
    Scalar squares = 0;
    for (const Scalar& slope : result.slopes) squares += slope * slope;
    return std::sqrt(squares / static_cast<Scalar>(result.slopes.size()));
  }

  /// A slope in u/s, or the height that decays with that slope at its beginning. The unit comes last: before, it could
  /// overflow.
  [[nodiscard]] Scalar trend_in_units(NoiseTerm term, Scalar slope, const Result& result) const {
    if (term == NoiseTerm::rate_ramp) return slope * spectrum_.rate() * spectrum_.unit();
    return slope / -std::expm1(-1 / (spectrum_.rate() * result.times.decay)) * spectrum_.unit();
  }

  /// The coefficient of a term whose √θ this is; of a Gauss–Markov bias, of √(θ·correlation time).
  [[nodiscard]] Scalar in_units(NoiseTerm term, Scalar root) const {
    const Scalar rate = spectrum_.rate(), unit = spectrum_.unit();
    switch (term) {
      case NoiseTerm::white:
        return root / std::sqrt(rate) * unit;
      case NoiseTerm::random_walk:
        return root * std::sqrt(rate) * unit;
      case NoiseTerm::quantization:
        return root / rate * unit;
      case NoiseTerm::gauss_markov:
        return root * std::sqrt(rate / 2) * unit;
      default:
        return root * unit;
    }
  }

  void estimate(NoiseTerm term, const std::vector<Model>& models, NoiseEstimates<Scalar>& result) const {
    Estimate<Scalar>& estimate = result[term];
    estimate.detected = selection_->detects(term) && claimable(term, result);
    bool first = true;
    // Beside a walk, a Gauss–Markov bias is one that forgets more slowly than the log can tell.
    const bool walks = term == NoiseTerm::random_walk &&
                       std::any_of(models.begin(), models.end(), [](const Model& model) {
                         return model.terms.has(NoiseTerm::random_walk);
                       });
    for (const Model& model : models) {
      const bool walk_like =
          walks && model.terms.has(NoiseTerm::gauss_markov) && !model.terms.has(NoiseTerm::random_walk);
      if (!model.terms.has(term) && !walk_like) continue;
      estimate.possible = true;
      add(walk_like ? NoiseTerm::gauss_markov : term, walk_like, model, first && !walk_like, result, estimate);
      if (!walk_like) first = false;
    }
    if (!estimate.possible && term != NoiseTerm::gauss_markov && term != NoiseTerm::warm_up) {
      // The largest that it could be beside what is there.
      const Model& best = selection_->best();
      Model with{best.terms.with(term), {}, Scalar(0)};
      if (term == NoiseTerm::rate_ramp) with.terms = with.terms.without(NoiseTerm::warm_up);
      with.result = selection_->likelihood().maximise(with.terms, &best.result);
      add(term, false, with, true, result, estimate);
    }
    if (estimate.detected) estimate.possible = false;
    if (!estimate.detected) estimate.interval.lower = estimate.one_sigma.lower = Scalar(0);
  }

  /// Terms other than white noise are named only where the log is described by them.
  [[nodiscard]] bool claimable(NoiseTerm term, const NoiseEstimates<Scalar>& result) const {
    if (term == NoiseTerm::white) return true;
    if (!result.fits) return false;
    // The ends of a line that was left out look like a warm-up.
    if (term == NoiseTerm::warm_up) return result.excluded.empty();
    const auto& best = selection_->best();
    if (term == NoiseTerm::gauss_markov && best.terms.has(term)) {
      // What is flat below a band that was left out and falls inside it is that band's foot.
      const Scalar corner = 1 / (2 * std::numbers::pi_v<Scalar> * best.result.times.correlation);
      for (const auto& band : result.excluded) {
        if (band.frequencies.lower < 4 * corner && corner < 4 * band.frequencies.upper) return false;
      }
    }
    return true;
  }

  /// Widens an estimate by what one description says; the first also says the value.
  void add(NoiseTerm term, bool walk_like, const Model& model, bool first, NoiseEstimates<Scalar>& result,
           Estimate<Scalar>& estimate) const {
    const ProfileLikelihood<Scalar> profile(selection_->likelihood(), model.terms, model.result);
    const auto widen = [](Interval<Scalar>& whole, const Interval<Scalar>& more) {
      if (whole.upper == 0) {
        whole = more;
      } else {
        whole = {std::min(whole.lower, more.lower), std::max(whole.upper, more.upper)};
      }
    };
    const auto interval_at = [&](Scalar confidence) -> Interval<Scalar> {
      if (term == NoiseTerm::rate_ramp || term == NoiseTerm::warm_up) return trend_interval(term, model, confidence);
      if (term == NoiseTerm::gauss_markov && !walk_like) {
        const auto root = profile.gauss_markov_root(confidence);
        return {in_units(term, root.lower), in_units(term, root.upper)};
      }
      const auto root = profile.root(term, confidence);
      const NoiseTerm unit = walk_like ? NoiseTerm::random_walk : term;
      return {in_units(unit, root.lower), in_units(unit, root.upper)};
    };
    const Interval<Scalar> one_sigma_interval = interval_at(one_sigma<Scalar>);
    if (first) {
      estimate.value = term == NoiseTerm::rate_ramp || term == NoiseTerm::warm_up
                           ? trend_in_units(term, trend_size(model.result), model.result)
                           : (one_sigma_interval.lower + one_sigma_interval.upper) / 2;
      const auto& likelihood = selection_->likelihood();
      using Times = typename Fit::Times;
      if (term == NoiseTerm::gauss_markov) {
        result.G.time = model.result.times.correlation;
        result.G.time_interval = profile.time(&Times::correlation, likelihood.correlation_times(), options_.confidence);
      } else if (term == NoiseTerm::warm_up) {
        result.W.time = model.result.times.decay;
        result.W.time_interval = profile.time(&Times::decay, likelihood.decay_times(), options_.confidence);
      }
    }
    widen(estimate.interval, interval_at(options_.confidence));
    widen(estimate.one_sigma, one_sigma_interval);
  }

  /// As of a model that has a walk, too, if it has nothing slow: one that is too weak to show widens it, still.
  [[nodiscard]] Interval<Scalar> trend_interval(NoiseTerm term, const Model& model, Scalar confidence) const {
    NoiseTerms terms = model.terms;
    Result best = model.result;
    if (!terms.has(NoiseTerm::gauss_markov) && !terms.has(NoiseTerm::bias_instability) &&
        options_.candidates.has(NoiseTerm::random_walk)) {
      terms = terms.with(NoiseTerm::random_walk);
      best = selection_->likelihood().near(terms, model.result);
    }
    const Scalar centre = trend_size(model.result), count = static_cast<Scalar>(best.slopes.size());
    const Scalar half = std::sqrt(chi_square_quantile(confidence, Scalar(1)) / count) * best.slope_error;
    return {trend_in_units(term, std::max(centre - half, Scalar(0)), model.result),
            trend_in_units(term, centre + half, model.result)};
  }

  IdentifyOptions<Scalar> options_;
  std::span<const DifferenceSpectrum<Scalar>> spectra_;
  PooledSpectrum<Scalar> spectrum_;
  Scalar highest_;
  BandSelection<Scalar> bands_;
  std::optional<Fit> fit_;
  std::optional<Selection> selection_;
  typename FitBands<Scalar>::Window worst_{};
  std::vector<typename FitBands<Scalar>::Octave> octaves_;
  Scalar probability_{};
};

/// The noise of a static log: N, K, B, Q, R, a Gauss–Markov bias and a warm-up with intervals, or upper limits of what is
/// not in it. By maximum likelihood of the signal's differences, exact for white noise and random walk; the intervals
/// are those of the profile likelihood, over all descriptions of the log that are equally good. Throws
/// std::invalid_argument as IntegratedSignal and for options out of their range.
template <typename Scalar>
[[nodiscard]] NoiseEstimates<Scalar> identify(const IntegratedSignal<Scalar>& signal,
                                              const IdentifyOptions<Scalar>& options = {}) {
  const std::array<DifferenceSpectrum<Scalar>, 1> spectrum{DifferenceSpectrum<Scalar>(signal)};
  return Identification<Scalar>(spectrum, options).estimates();
}

/// Of a rate signal at `rate` samples a second.
template <Signal S>
[[nodiscard]] NoiseEstimates<ScalarOfSignal<S>> identify(const S& signal, ScalarOfSignal<S> rate,
                                                         const IdentifyOptions<ScalarOfSignal<S>>& options = {}) {
  return identify(IntegratedSignal<ScalarOfSignal<S>>(signal, rate), options);
}

/// One estimate for all axes of a sensor, if they are alike: their spectra together. Each axis has a ramp of its own; R
/// is the root mean square of them. The spectra are of signals with the same rate and number of samples, else
/// std::invalid_argument is thrown.
template <typename Scalar>
[[nodiscard]] NoiseEstimates<Scalar> identify_pooled(const std::vector<DifferenceSpectrum<Scalar>>& axes,
                                                     const IdentifyOptions<Scalar>& options = {}) {
  if (axes.empty()) throw std::invalid_argument("identify_pooled: no axes");
  for (const auto& axis : axes) {
    if (axis.rate() != axes[0].rate() || axis.samples() != axes[0].samples()) {
      throw std::invalid_argument(message("identify_pooled: an axis has ", axis.samples(), " samples at ", axis.rate(),
                                          " Hz, expected ", axes[0].samples(), " at ", axes[0].rate(), " Hz"));
    }
  }
  return Identification<Scalar>(axes, options).estimates();
}

}  // namespace splinertia::allan
