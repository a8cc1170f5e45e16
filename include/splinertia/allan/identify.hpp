// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <splinertia/allan/chi_square.hpp>
#include <splinertia/allan/difference_spectrum.hpp>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/allan/spectral_fit.hpp>
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
  /// Frequencies above this one [Hz] are not used. Zero: all up to rate/2, but for octaves at the upper end that white
  /// noise does not describe (the sensor's low-pass filter, vibration, hum).
  Scalar highest_frequency = 0;
};

/// Identification of a model by its likelihood; what identify() below does step by step.
template <typename Scalar>
class Identification {
 public:
  Identification(std::span<const DifferenceSpectrum<Scalar>> spectra, const IdentifyOptions<Scalar>& options)
      : options_(options), rate_(spectra[0].rate()), highest_(rate_ / 2), fit_(spectra, highest_) {
    require(options.confidence > 0 && options.confidence < 1, "identify", "confidence", options.confidence,
            "a number between 0 and 1");
    require_non_negative("identify", "highest_frequency", options.highest_frequency);
    if (options.candidates.without(NoiseTerm::rate_ramp).empty()) {
      throw std::invalid_argument("identify: no candidates but a rate ramp, expected a noise term");
    }
    if (options.highest_frequency > 0) restrict_to(spectra, options.highest_frequency);
    select();
    if (options.highest_frequency > 0) return;
    bool restricted = false;
    while (!fits() && drop_octave(spectra)) restricted = true;
    // What bends the octave that is left out bends the next one, too, below what shows in it.
    if (restricted) drop_octave(spectra);
  }

  [[nodiscard]] NoiseEstimates<Scalar> estimates() const {
    NoiseEstimates<Scalar> result;
    for (const NoiseTerm term : noise_terms) {
      if (options_.candidates.has(term)) result[term] = estimate(term);
    }
    result.highest_frequency = highest_;
    result.fits = fits();
    for (const auto& band : bands_) {
      result.bands.push_back({{band.lowest, band.highest}, band.ratio, band.standard_error});
    }
    return result;
  }

 private:
  using Fit = SpectralFit<Scalar>;
  using Result = typename Fit::Result;

  void restrict_to(std::span<const DifferenceSpectrum<Scalar>> spectra, Scalar highest) {
    const Scalar first = spectra[0].bins().front().frequency;
    if (!(highest > 8 * first)) {
      throw std::invalid_argument(message("identify: highest_frequency is ", highest,
                                          " Hz, expected more than eight times the lowest of the log, ", first, " Hz"));
    }
    fit_ = Fit(spectra, highest);
    highest_ = std::min(highest, rate_ / 2);
  }

  /// Leaves out the highest octave, if enough is left.
  bool drop_octave(std::span<const DifferenceSpectrum<Scalar>> spectra) {
    const Scalar below = bands_.front().lowest * (1 - std::numeric_limits<Scalar>::epsilon());
    Fit fit(spectra, below);
    if (below < rate_ / 256 || fit.bins() < 64) return false;
    fit_ = std::move(fit);
    highest_ = below;
    select();
    return true;
  }

  /// The set of terms that is most likely after a price for each: that of a detection at 1 %. Where a random walk
  /// describes a log almost as well as bias instability it is the walk, which estimators model. A walk of which a log
  /// holds few independent periods looks like a ramp more often than Gaussian theory says (4 % at one price, 1 % at
  /// two): a ramp costs three.
  void select() {
    const Scalar level = Scalar(99) / 100;
    const Scalar price = chi_square_quantile(level, Scalar(1));
    const Scalar ramp_price = 3 * chi_square_quantile(level, static_cast<Scalar>(fit_.spectra()));
    std::array<Scalar, NoiseTerms::sets> costs;
    constexpr Scalar untried = std::numeric_limits<Scalar>::max();
    costs.fill(untried);
    std::array<Result, NoiseTerms::sets> results;
    for (unsigned set = 1; set < NoiseTerms::sets; ++set) {
      const NoiseTerms model = NoiseTerms::numbered(set);
      if (!model.within(options_.candidates) || model == NoiseTerms{NoiseTerm::rate_ramp}) continue;
      const Result* simpler = nullptr;
      Scalar prices = 0;
      for (const NoiseTerm term : noise_terms) {
        if (!model.has(term)) continue;
        prices += term == NoiseTerm::rate_ramp ? ramp_price : price;
        const unsigned without = model.without(term).number();
        if (costs[without] == untried) continue;
        if (simpler == nullptr || results[without].objective < simpler->objective) simpler = &results[without];
      }
      results[set] = simpler == nullptr ? fit_.maximise(model) : maximum(model, *simpler);
      costs[set] = results[set].objective + prices;
    }
    auto best = static_cast<unsigned>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    if (const NoiseTerms model = NoiseTerms::numbered(best);
        model.has(NoiseTerm::bias_instability) && !model.has(NoiseTerm::random_walk)) {
      const NoiseTerms rest = model.without(NoiseTerm::bias_instability);
      const unsigned walk = rest.with(NoiseTerm::random_walk).number();
      if (costs[walk] < costs[best] + price) best = costs[rest.number()] < costs[walk] ? rest.number() : walk;
    }
    model_ = NoiseTerms::numbered(best);
    result_ = std::move(results[best]);
    bands_ = fit_.bands(result_);
  }

  /// The likelihood can have several maxima, with more of the walk or of the ramp. The better one of what the signal
  /// leads to and what a model with fewer terms does: more terms are never less likely.
  [[nodiscard]] Result maximum(NoiseTerms model, const Result& simpler) const {
    Result result = fit_.maximise(model), other = fit_.maximise(model, {}, &simpler.theta);
    return other.objective < result.objective ? other : result;
  }

  /// The power agrees with the model in each octave; or in those of which white noise makes up more than half, if the
  /// highest is among them: that something slow is in the log that is none of the terms is no reason to give up N.
  [[nodiscard]] bool fits() const {
    // Within 0.5 %, or what chance does once in a million.
    const auto agrees = [](const auto& band) {
      // The cube root of a mean of squares is all but normal: Wilson and Hilferty, PNAS 17 (1931).
      const Scalar variance = band.standard_error * band.standard_error / 9;
      const Scalar off = (std::cbrt(band.ratio) - (1 - variance)) / std::sqrt(variance);
      return std::abs(band.ratio - 1) <= Scalar(5) / 1000 || std::abs(off) <= 5;
    };
    const auto white = [](const auto& band) { return band.white_share > Scalar(1) / 2; };
    return std::all_of(bands_.begin(), bands_.end(), agrees) ||
           (white(bands_.front()) &&
            std::all_of(bands_.begin(), bands_.end(), [&](const auto& band) { return !white(band) || agrees(band); }));
  }

  [[nodiscard]] Estimate<Scalar> estimate(NoiseTerm term) const {
    Estimate<Scalar> estimate;
    estimate.detected = model_.has(term);
    const NoiseTerms model = model_.with(term);
    const Result best = estimate.detected ? result_ : maximum(model, result_);
    const Scalar wanted = chi_square_quantile(options_.confidence, Scalar(1));
    if (term == NoiseTerm::rate_ramp) {
      Scalar squares = 0;
      for (const Scalar& slope : best.slopes) squares += slope * slope;
      const auto count = static_cast<Scalar>(best.slopes.size());
      const auto in_units = [&](Scalar slope) { return slope * rate_ * fit_.unit(); };
      estimate.value = in_units(std::sqrt(squares / count));
      const auto within = [&](Scalar drop) {
        const Scalar half = in_units(std::sqrt(drop / count) * best.slope_error);
        return Interval<Scalar>{std::max(estimate.value - half, Scalar(0)), estimate.value + half};
      };
      estimate.interval = within(wanted);
      estimate.one_sigma = within(Scalar(1));
    } else {
      const auto j = static_cast<Eigen::Index>(term);
      const Scalar root = std::sqrt(best.theta[j]);
      // The squared relative error e² of the root is that of a scale known from 1/(2e²) squares. Of few, the ratio of
      // likelihoods is larger than of many by 1 + 2e²/3 (Bartlett, Proc. R. Soc. A 160 (1937)).
      const Scalar share = root > 0 ? profile_end(model, term, best, Scalar(1), true) / root - 1 : Scalar(1);
      const Scalar error = std::min(share * share, Scalar(1) / 2);
      const auto within = [&](Scalar drop) {
        const Scalar corrected = drop * (1 + 2 * error / 3);
        return Interval<Scalar>{in_units(term, profile_end(model, term, best, corrected, false)),
                                in_units(term, profile_end(model, term, best, corrected, true))};
      };
      estimate.interval = within(wanted);
      estimate.one_sigma = within(Scalar(1));
      estimate.value = (estimate.one_sigma.lower + estimate.one_sigma.upper) / 2;
    }
    if (!estimate.detected) estimate.interval.lower = estimate.one_sigma.lower = Scalar(0);
    return estimate;
  }

  /// The coefficient of a term whose √θ this is. The unit comes last: before, it could overflow.
  [[nodiscard]] Scalar in_units(NoiseTerm term, Scalar root) const {
    switch (term) {
      case NoiseTerm::white:
        return root / std::sqrt(rate_) * fit_.unit();
      case NoiseTerm::random_walk:
        return root * std::sqrt(rate_) * fit_.unit();
      case NoiseTerm::quantization:
        return root / rate_ * fit_.unit();
      default:
        return root * fit_.unit();
    }
  }

  /// The √θ below or above the most likely one at which −2·log-likelihood, all else at its best, is `drop` higher: the
  /// end of the likelihood interval, which has its level whatever function of θ is looked at (Wilks).
  [[nodiscard]] Scalar profile_end(NoiseTerms model, NoiseTerm term, const Result& best, Scalar drop,
                                   bool above) const {
    const auto j = static_cast<Eigen::Index>(term);
    typename Fit::Vector start = best.theta;
    const auto excess = [&](Scalar root) {
      start[j] = root * root;
      const Result result = fit_.maximise(model, typename Fit::Fixed{term, root * root}, &start);
      start = result.theta;
      return result.objective - best.objective - drop;
    };
    const Scalar centre = std::sqrt(best.theta[j]);
    Scalar inside = centre, outside = Scalar(0);
    if (above) {
      // A first step that is some share of what all the power could be.
      Scalar reach = std::max(centre / 8, std::sqrt(std::max(best.theta.sum(), Fit::floor())) / 1'000'000);
      outside = centre + reach;
      while (excess(outside) < 0) {
        inside = outside;
        reach *= 2;
        outside = centre + reach;
      }
    } else if (excess(Scalar(0)) <= 0) {
      return Scalar(0);
    }
    // Bisection: each step is a fit that starts next to its solution, and twenty settle the end to 1e-6 of its
    // distance.
    for (int i = 0; i < 20; ++i) {
      const Scalar middle = (inside + outside) / 2;
      (excess(middle) < 0 ? inside : outside) = middle;
    }
    return (inside + outside) / 2;
  }

  IdentifyOptions<Scalar> options_;
  Scalar rate_;
  Scalar highest_;
  Fit fit_;
  NoiseTerms model_;
  Result result_;
  std::vector<typename Fit::BandFit> bands_;
};

/// The noise of a static log: N, K, B, Q and R with intervals, or upper limits of what is not in it. By maximum
/// likelihood of the signal's differences, exact for white noise and random walk; the intervals are those of the
/// profile likelihood. Throws std::invalid_argument as IntegratedSignal and for options out of their range.
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
