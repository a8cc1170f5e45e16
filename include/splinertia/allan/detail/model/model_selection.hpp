// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <splinertia/allan/detail/deterministic_drift.hpp>
#include <splinertia/allan/detail/model/model_likelihood.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan::detail {

[[nodiscard]] constexpr bool has_trend(NoiseTerms t) {
  return t.has(NoiseTerm::rate_ramp) || t.has(NoiseTerm::warm_up);
}

/// Finds the sets of terms that describe a log.
///
/// The cost of a model is −2·log-likelihood plus 3 for each parameter, 9 for the slope of a trend: a walk of which a
/// log holds few independent periods looks like a ramp more often than Gaussian theory says. Models that cost up to 6
/// more than the best describe the log equally well, as far as it can tell. An additional term must therefore gain 9,
/// which an absent term does in one log in 700 (Wilks; at the border θ = 0). The true model, if it is among the models,
/// is among the descriptions in 99 % of logs (measured: docs/performance.md). A term that all descriptions have is
/// therefore in the log with that confidence. A term that only some have may be in it or not.
template <typename Scalar>
class ModelSelection {
 public:
  using Likelihood = ModelLikelihood<Scalar>;
  using Result = typename Likelihood::Result;

  struct Model {
    NoiseTerms terms;
    Result result;
    Scalar cost;
  };

  ModelSelection(std::reference_wrapper<const SpectralFit<Scalar>> fit, NoiseTerms candidates)
      : likelihood_(fit), candidates_(candidates) {
    using enum NoiseTerm;
    std::vector<NoiseTerms> sets;
    for (unsigned number = 1; number < NoiseTerms::sets; ++number) {
      const NoiseTerms terms = NoiseTerms::numbered(number);
      if (is_model(terms) && terms.within(candidates)) sets.push_back(terms);
    }
    // Simpler sets come first, as starting points for others. Sets without quantization noise come before all others:
    // it hardly affects the slow terms, so that if it does not improve the best model, it does not improve the others.
    std::stable_sort(sets.begin(), sets.end(), [](NoiseTerms a, NoiseTerms b) {
      return std::pair(a.has(quantization), count(a)) < std::pair(b.has(quantization), count(b));
    });
    bool quantized = true, tried = false;
    for (const NoiseTerms terms : sets) {
      if (terms.has(quantization) && !tried && !models_.empty()) {
        tried = true;
        const NoiseTerms with = best().terms.with(quantization);
        const Result result = likelihood_.maximise(with, &best().result);
        quantized = best().result.objective - result.objective > 1 || !best().terms.has(white);
      }
      if (terms.has(quantization) && !quantized) continue;
      add(terms);
    }
    std::stable_sort(models_.begin(), models_.end(), [](const Model& a, const Model& b) { return a.cost < b.cost; });
    look_for_drift();
  }

  [[nodiscard]] const Likelihood& likelihood() const { return likelihood_; }
  /// The best model and all that cost less than 3 more, the price of a parameter. Cheapest first.
  [[nodiscard]] std::vector<Model> best_models() const {
    std::vector<Model> found;
    std::copy_if(models_.begin(), models_.end(), std::back_inserter(found),
                 [&](const Model& model) { return model.cost < best_cost_ + price; });
    return found;
  }
  /// The models that describe the log as well as the best, without those that have all terms of another one and more.
  /// Cheapest first.
  [[nodiscard]] std::vector<Model> descriptions() const {
    std::vector<Model> found;
    for (const Model& model : models_) {
      if (!plausible(model)) break;
      const bool more = std::any_of(models_.begin(), models_.end(), [&](const Model& other) {
        // A walk replaces a Gauss–Markov bias unless the correlation time gains what it costs.
        const bool stands = other.terms.within(model.terms) || other.cost <= model.cost + price;
        return plausible(other) && other.terms != model.terms && stands && covers(model.terms, other.terms) &&
               (!covers(other.terms, model.terms) || count(other.terms) < count(model.terms));
      });
      if (!more) found.push_back(model);
    }
    return found;
  }
  [[nodiscard]] const Model& best() const {
    return *std::min_element(models_.begin(), models_.end(),
                             [](const Model& a, const Model& b) { return a.cost < b.cost; });
  }

  /// A deterministic mean that, instead of slow noise, describes the log as well as the best model does. Nothing if
  /// there is none.
  [[nodiscard]] const std::optional<DeterministicDrift<Scalar>>& drift() const { return drift_; }

  /// Whether every description has the term. A Gauss–Markov bias with a correlation time too long for the log to show
  /// counts as a walk: the time must gain what it costs.
  [[nodiscard]] bool detects(NoiseTerm term) const {
    const bool wanders =
        term == NoiseTerm::random_walk || term == NoiseTerm::bias_instability || term == NoiseTerm::gauss_markov;
    if (wanders && drift_) return false;
    const bool walk = term == NoiseTerm::random_walk;
    if (!best().terms.has(term) || (walk && best().terms.has(NoiseTerm::gauss_markov))) return false;
    return std::all_of(models_.begin(), models_.end(), [&](const Model& model) {
      return !plausible(model) || model.terms.has(term) || (walk && model.terms.has(NoiseTerm::gauss_markov));
    });
  }

 private:
  static constexpr Scalar price = 3, trend_price = 9, margin = 6;

  /// Whether the first has the terms of the second. A Gauss–Markov bias can stand for a walk, which is its limit.
  [[nodiscard]] static bool covers(NoiseTerms terms, NoiseTerms others) {
    if (terms.has(NoiseTerm::gauss_markov)) others = others.without(NoiseTerm::random_walk);
    return others.within(terms);
  }

  [[nodiscard]] static unsigned count(NoiseTerms terms) {
    unsigned sum = 0;
    for (const NoiseTerm term : noise_terms) sum += terms.has(term) ? 1 : 0;
    return sum;
  }

  /// Models have at most two slow terms, or walk, flicker and a trend. Without white noise they have neither a
  /// Gauss–Markov bias nor a warm-up, and not a ramp alone. More models could hardly be told from these.
  [[nodiscard]] static bool is_model(NoiseTerms terms) {
    using enum NoiseTerm;
    const bool walk_and_flicker = terms.has(random_walk) && terms.has(bias_instability);
    const unsigned slow = count(terms.without(white).without(quantization));
    if (terms.has(rate_ramp) && terms.has(warm_up)) return false;
    if (slow > (walk_and_flicker && !terms.has(gauss_markov) ? 3U : 2U)) return false;
    if (terms.has(white)) return true;
    return !terms.has(gauss_markov) && !terms.has(warm_up) && !terms.without(rate_ramp).empty();
  }

  [[nodiscard]] bool plausible(const Model& model) const { return model.cost <= best_cost_ + margin; }

  /// Looks for a deterministic mean that may replace the slow terms of the best model.
  void look_for_drift() {
    using enum NoiseTerm;
    using Fit = SpectralFit<Scalar>;
    const Fit& fit = likelihood_.fit();
    const Model& best = models_.front();
    const NoiseTerms slow = best.terms.without(white).without(quantization);
    const bool still = std::any_of(models_.begin(), models_.end(), [&](const Model& model) {
      return plausible(model) && model.terms.within(NoiseTerms{white, quantization});
    });
    if (still) return;  // no slow term is detected
    // If the candidates have no drift, the user knows that there is none.
    if (slow.empty() || !best.terms.has(white) || !(candidates_.has(rate_ramp) || candidates_.has(warm_up))) return;
    std::vector<Scalar> expected;
    const auto& theta = best.result.theta;
    for (const auto& bin : fit.spectrum().bins()) {
      Scalar power = 0;
      for (const NoiseTerm term : {white, quantization})
        power += bin.basis[Fit::index_of(term)] * theta[Fit::index_of(term)];
      expected.push_back((std::max)(power, Fit::floor()));
    }
    auto drift = best_drift(fit.spectrum(), fit.included(), expected);
    const Scalar fast = price * static_cast<Scalar>(count(best.terms) - count(slow));
    if (fit.fast_objective(theta) + fast - drift.gain <= best_cost_ + margin) drift_ = std::move(drift);
  }

  void add(NoiseTerms terms) {
    const auto spectra = static_cast<Scalar>(likelihood_.fit().spectrum().spectra());
    const bool trend = terms.has(NoiseTerm::rate_ramp) || terms.has(NoiseTerm::warm_up);
    Scalar prices = price * static_cast<Scalar>(count(terms.without(NoiseTerm::rate_ramp)));
    if (terms.has(NoiseTerm::gauss_markov)) prices += price;
    if (trend) prices += trend_price * spectra;
    const Result* simpler = nullptr;
    for (const Model& model : models_) {
      if (model.terms.within(terms) && (simpler == nullptr || model.result.objective < simpler->objective)) {
        simpler = &model.result;
      }
    }
    Result result = likelihood_.maximise(terms, simpler);
    // A warm-up whose decay time gains nothing is a ramp.
    if (terms.has(NoiseTerm::warm_up)) {
      const NoiseTerms ramp = terms.without(NoiseTerm::warm_up).with(NoiseTerm::rate_ramp);
      const bool idle = std::any_of(models_.begin(), models_.end(), [&](const Model& model) {
        return model.terms == ramp && model.result.objective - result.objective < price;
      });
      // Without a ramp among the candidates, a warm-up that does not settle within the log.
      const bool unsettled = result.times.decay > likelihood_.fit().spectrum().duration();
      if (idle || (!candidates_.has(NoiseTerm::rate_ramp) && unsettled)) return;
    }
    const Scalar cost = result.objective + prices;
    best_cost_ = models_.empty() ? cost : (std::min)(best_cost_, cost);
    models_.push_back({terms, std::move(result), cost});
  }

  Likelihood likelihood_;
  NoiseTerms candidates_;
  std::vector<Model> models_;
  Scalar best_cost_{};
  std::optional<DeterministicDrift<Scalar>> drift_;
};

}  // namespace splinertia::allan::detail
