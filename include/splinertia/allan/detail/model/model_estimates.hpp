// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/model/model_selection.hpp>
#include <splinertia/allan/detail/model/profile_likelihood.hpp>
#include <splinertia/allan/interval.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/pi.hpp>
#include <vector>

namespace splinertia::allan::detail {

/// Estimates of each term from the models that describe a log, in the units of the signal.
template <typename Scalar>
class ModelEstimates {
 public:
  ModelEstimates(std::reference_wrapper<const ModelSelection<Scalar>> all, Scalar confidence, NoiseTerms candidates)
      : selection_(all), confidence_(confidence), candidates_(candidates) {}

  /// Writes descriptions and estimates to a result in which fits and excluded are set.
  void write_to(NoiseEstimates<Scalar>& result) const {
    const auto descriptions = selection_.descriptions();
    for (const Model& model : descriptions) {
      result.descriptions.push_back(described(model));
      result.descriptions.back().cost -= selection_.best().cost;
    }
    result.considered = candidates_;
    if (const auto& drift = selection_.drift()) {
      result.may_be_drift = true;
      result.step_times = drift->steps;
    }
    const auto best = selection_.best_models();
    for (const NoiseTerm term : noise_terms) {
      if (!candidates_.has(term)) continue;
      const bool described_by = std::any_of(descriptions.begin(), descriptions.end(),
                                            [&](const Model& model) { return model.terms.has(term); });
      // Slow terms also share their power with others in larger models. White and quantization noise hardly do.
      const bool fast = term == NoiseTerm::white || term == NoiseTerm::quantization;
      estimate(term, described_by && !fast ? with(descriptions, best) : descriptions, result);
    }
    if (result.K.detected) result.least_correlation_time = least_correlation_time();
  }

 private:
  using Fit = SpectralFit<Scalar>;
  using Model = typename ModelSelection<Scalar>::Model;
  using Result = typename Fit::Result;

  /// Searches down from the longest time by octaves, then by three bisections.
  [[nodiscard]] Scalar least_correlation_time() const {
    const Model& best = selection_.best();
    const auto& likelihood = selection_.likelihood();
    const NoiseTerms terms = best.terms.without(NoiseTerm::random_walk).with(NoiseTerm::gauss_markov);
    const Scalar drop = chi_square_quantile(Scalar(95) / 100, Scalar(1));
    Result start = best.result;
    start.theta[Fit::index_of(NoiseTerm::gauss_markov)] = start.theta[Fit::index_of(NoiseTerm::random_walk)];
    const auto as_good = [&](Scalar time) {
      auto times = best.result.times;
      times.correlation = time;
      return likelihood.at(terms, times, start).objective <= best.result.objective + drop;
    };
    Scalar good = 4 * likelihood.correlation_times().upper, bad = good;
    while (bad > likelihood.correlation_times().lower && as_good(bad)) {
      good = bad;
      bad /= 2;
    }
    for (int i = 0; i < 3; ++i) {
      const Scalar middle = std::sqrt(good * bad);
      (as_good(middle) ? good : bad) = middle;
    }
    return good;
  }

  /// The models of the first list, and those of the second with other terms.
  [[nodiscard]] static std::vector<Model> with(std::vector<Model> models, const std::vector<Model>& more) {
    for (const Model& model : more) {
      if (std::none_of(models.begin(), models.end(), [&](const Model& one) { return one.terms == model.terms; })) {
        models.push_back(model);
      }
    }
    return models;
  }

  [[nodiscard]] const PooledSpectrum<Scalar>& spectrum() const { return selection_.likelihood().fit().spectrum(); }

  [[nodiscard]] Description<Scalar> described(const Model& model) const {
    Description<Scalar> description{.terms = model.terms, .cost = model.cost};
    const auto set = [&](NoiseTerm term, Scalar value) { description.values[static_cast<std::size_t>(term)] = value; };
    for (const NoiseTerm term : Fit::spectral_terms) {
      const Scalar theta = model.result.theta[Fit::index_of(term)];
      if (model.terms.has(term) && term != NoiseTerm::gauss_markov) set(term, in_units(term, std::sqrt(theta)));
    }
    if (model.terms.has(NoiseTerm::gauss_markov)) {
      const Scalar time = model.result.times.correlation;
      set(NoiseTerm::gauss_markov,
          in_units(NoiseTerm::gauss_markov,
                   std::sqrt(model.result.theta[Fit::index_of(NoiseTerm::gauss_markov)] * time)));
      description.correlation_time = time;
    }
    if (has_trend(model.terms)) {
      const NoiseTerm term = model.terms.has(NoiseTerm::rate_ramp) ? NoiseTerm::rate_ramp : NoiseTerm::warm_up;
      set(term, trend_in_units(term, trend_size(model.result), model.result));
      if (term == NoiseTerm::warm_up) description.decay_time = model.result.times.decay;
    }
    return description;
  }

  /// Root mean square of the slopes of all axes, unit() per sample.
  [[nodiscard]] static Scalar trend_size(const Result& result) {
    Scalar squares = 0;
    for (const Scalar& slope : result.slopes) squares += slope * slope;
    return std::sqrt(squares / static_cast<Scalar>(result.slopes.size()));
  }

  /// The slope of a ramp in u/s, or the height in u of a warm-up with this slope at its beginning. The unit is
  /// multiplied last, to avoid overflow.
  [[nodiscard]] Scalar trend_in_units(NoiseTerm term, Scalar slope, const Result& result) const {
    if (term == NoiseTerm::rate_ramp) return slope * spectrum().rate() * spectrum().unit();
    return slope / -std::expm1(-1 / (spectrum().rate() * result.times.decay)) * spectrum().unit();
  }

  /// The coefficient of a term, from its √θ; of a Gauss–Markov bias, from √(θ·correlation time).
  [[nodiscard]] Scalar in_units(NoiseTerm term, Scalar root) const {
    const Scalar rate = spectrum().rate(), unit = spectrum().unit();
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
    estimate.detected = selection_.detects(term) && claimable(term, result);
    bool first = true;
    // Besides models with a walk, a Gauss–Markov bias counts as one: its time may be too long to show.
    const bool walks = term == NoiseTerm::random_walk &&
                       std::any_of(models.begin(), models.end(),
                                   [](const Model& model) { return model.terms.has(NoiseTerm::random_walk); });
    for (const Model& model : models) {
      const bool walk_like =
          walks && model.terms.has(NoiseTerm::gauss_markov) && !model.terms.has(NoiseTerm::random_walk);
      if (!model.terms.has(term) && !walk_like) continue;
      estimate.possible = true;
      add(walk_like ? NoiseTerm::gauss_markov : term, walk_like, model, first && !walk_like, result, estimate);
      if (!walk_like) first = false;
    }
    if (!estimate.possible && term != NoiseTerm::gauss_markov && term != NoiseTerm::warm_up) {
      // The upper limit besides the terms of the best model.
      const Model& best = selection_.best();
      Model with{best.terms.with(term), {}, Scalar(0)};
      if (term == NoiseTerm::rate_ramp) with.terms = with.terms.without(NoiseTerm::warm_up);
      with.result = selection_.likelihood().maximise(with.terms, &best.result);
      add(term, false, with, true, result, estimate);
    }
    if (estimate.detected) estimate.possible = false;
    if (!estimate.detected) estimate.interval.lower = estimate.one_sigma.lower = Scalar(0);
  }

  /// Whether a term may be called detected. Terms other than white noise need a model that fits. Near a band that was
  /// left out because it has more power, a slow term may be the foot of that band. A trend may be what a line in it
  /// leaves at the ends of the log.
  [[nodiscard]] bool claimable(NoiseTerm term, const NoiseEstimates<Scalar>& result) const {
    if (term == NoiseTerm::white) return true;
    if (!result.fits) return false;
    if (term == NoiseTerm::quantization) return true;
    // A time at the lower end of its range is shorter in truth, as that of a filter or of vibration.
    const auto& best = selection_.best();
    if (term == NoiseTerm::gauss_markov && best.terms.has(term) &&
        best.result.times.correlation < selection_.likelihood().correlation_times().lower * 11 / 10) {
      return false;
    }
    const bool trend = term == NoiseTerm::rate_ramp || term == NoiseTerm::warm_up;
    const Scalar reach = result.excluded.empty() || trend ? Scalar(0) : 4 * highest_slow_frequency();
    return std::none_of(result.excluded.begin(), result.excluded.end(), [&](const BandFit<Scalar>& band) {
      // A band with the expected power was left out by the user.
      if (band.ratio > Scalar(4) / 5 && band.ratio < Scalar(5) / 4) return false;
      return trend || band.frequencies.lower < reach;
    });
  }

  /// Where slow terms cease to be more than a third of the power, or the corner of a Gauss–Markov bias if higher, Hz.
  [[nodiscard]] Scalar highest_slow_frequency() const {
    const auto& best = selection_.best();
    const Scalar corner = best.terms.has(NoiseTerm::gauss_markov)
                              ? 1 / (2 * splinertia::detail::pi_of<Scalar>() * best.result.times.correlation)
                              : Scalar(0);
    const auto all = selection_.likelihood().fit().compare(best.result, has_trend(best.terms));
    std::size_t end = 0;
    while (end < all.size() && all[end].expected > all[end].white * 3 / 2) ++end;
    return (std::max)(corner, end > 0 ? spectrum().bins()[end - 1].frequency : Scalar(0));
  }

  /// Widens the intervals by those of one description. The first description also sets the value.
  void add(NoiseTerm term, bool walk_like, const Model& model, bool first, NoiseEstimates<Scalar>& result,
           Estimate<Scalar>& estimate) const {
    const ProfileLikelihood<Scalar> profile(selection_.likelihood(), model.terms, model.result);
    const auto interval_at = [&](Scalar confidence) -> Interval<Scalar> {
      if (term == NoiseTerm::rate_ramp) return trend_interval(term, model, confidence);
      if (term == NoiseTerm::warm_up) return warm_up_interval(model, profile, confidence);
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
      set_time(term, profile, model, result);
    }
    // A larger model that shares the power of a detected term says nothing about its lower end.
    const auto bounded = [&](Interval<Scalar> more, const Interval<Scalar>& whole) {
      if (estimate.detected && !first && more.lower == 0) more.lower = whole.lower;
      return more;
    };
    widen(estimate.interval, bounded(interval_at(confidence_), estimate.interval));
    widen(estimate.one_sigma, bounded(one_sigma_interval, estimate.one_sigma));
  }

  /// The correlation time of G or the time constant of W; nothing for other terms.
  void set_time(NoiseTerm term, const ProfileLikelihood<Scalar>& profile, const Model& model,
                NoiseEstimates<Scalar>& result) const {
    const auto& likelihood = selection_.likelihood();
    using Times = typename Fit::Times;
    if (term == NoiseTerm::gauss_markov) {
      result.G.time = model.result.times.correlation;
      result.G.time_interval = profile.time(&Times::correlation, likelihood.correlation_times(), confidence_);
    } else if (term == NoiseTerm::warm_up) {
      result.W.time = model.result.times.decay;
      result.W.time_interval = profile.time(&Times::decay, likelihood.decay_times(), confidence_);
    }
  }

  /// A model without slow noise gets a walk here, because one too weak to be detected still widens the interval.
  [[nodiscard]] Interval<Scalar> trend_interval(NoiseTerm term, const Model& model, Scalar confidence) const {
    NoiseTerms terms = model.terms;
    Result best = model.result;
    if (!terms.has(NoiseTerm::gauss_markov) && !terms.has(NoiseTerm::bias_instability) &&
        candidates_.has(NoiseTerm::random_walk)) {
      terms = terms.with(NoiseTerm::random_walk);
      best = selection_.likelihood().maximum_near(terms, model.result);
    }
    const Scalar centre = trend_size(model.result), count = static_cast<Scalar>(best.slopes.size());
    Scalar quantile = std::sqrt(chi_square_quantile(confidence, Scalar(1)));
    const Scalar walk = std::sqrt(best.theta[Fit::index_of(NoiseTerm::random_walk)]);
    if (terms.has(NoiseTerm::random_walk) && walk > 0) {
      // A walk with the squared relative error e² has 1/(2e²) degrees of freedom: Student's quantile, to first order in
      // their inverse (Abramowitz and Stegun, 26.7.5).
      const ProfileLikelihood<Scalar> profile(selection_.likelihood(), terms, best);
      const Scalar error =
          (std::min)(profile.root(NoiseTerm::random_walk, one_sigma<Scalar>).upper / walk - 1, Scalar(1) / 2);
      quantile *= 1 + (quantile * quantile + 1) * error * error / 2;
    }
    const Scalar half = quantile / std::sqrt(count) * best.slope_error;
    return {trend_in_units(term, (std::max)(centre - half, Scalar(0)), model.result),
            trend_in_units(term, centre + half, model.result)};
  }

  /// The height depends on the decay time: the interval includes the heights at both ends of that time's interval.
  [[nodiscard]] Interval<Scalar> warm_up_interval(const Model& model, const ProfileLikelihood<Scalar>& profile,
                                                  Scalar confidence) const {
    const auto& likelihood = selection_.likelihood();
    Interval<Scalar> whole = trend_interval(NoiseTerm::warm_up, model, confidence);
    const auto range = profile.time(&Fit::Times::decay, likelihood.decay_times(), confidence);
    for (const Scalar decay : {range.lower, range.upper}) {
      auto times = model.result.times;
      times.decay = decay;
      const Result at = likelihood.at(model.terms, times, model.result);
      const Scalar height = trend_in_units(NoiseTerm::warm_up, trend_size(at), at);
      whole = {(std::min)(whole.lower, height), (std::max)(whole.upper, height)};
    }
    return whole;
  }

  const ModelSelection<Scalar>& selection_;
  Scalar confidence_;
  NoiseTerms candidates_;
};

}  // namespace splinertia::allan::detail
