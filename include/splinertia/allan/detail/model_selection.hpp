// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <splinertia/allan/detail/deterministic_drift.hpp>
#include <splinertia/allan/detail/model_likelihood.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan {

/// Which sets of terms describe a log.
///
/// A model costs −2·log-likelihood and 3 for each parameter, 9 for the slope of a trend: a walk of which a log holds
/// few independent periods looks like a ramp more often than Gaussian theory says. What costs up to 6 more than the
/// best is as good a description as far as this log can tell: a term more has to gain 9, which one that is not there
/// does in one log in 700 (Wilks; at the border θ = 0), and the truth, if it is one of the models, is among the
/// descriptions in 99 % of logs (measured: docs/performance.md). So what all descriptions have in common is in the log
/// with that confidence, and what only some have may be in it or not.
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
    // Simpler ones first, for others to start from; without quantization noise first, which hardly touches the slow
    // terms: if it does not help the best, it does not help the others.
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
  /// The best, and those whose parameters pay for themselves as well: the cheapest first.
  [[nodiscard]] std::vector<Model> best_models() const {
    std::vector<Model> found;
    std::copy_if(models_.begin(), models_.end(), std::back_inserter(found),
                 [&](const Model& model) { return model.cost < best_cost_ + price; });
    return found;
  }
  /// What describes the log as well as the best, without models that have all terms of another one and more: the
  /// cheapest first.
  [[nodiscard]] std::vector<Model> descriptions() const {
    std::vector<Model> found;
    for (const Model& model : models_) {
      if (!plausible(model)) break;
      const bool more = std::any_of(models_.begin(), models_.end(), [&](const Model& other) {
        // A walk stands for a Gauss–Markov bias unless that it forgets gains what its time costs.
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

  /// A mean that describes the log as well as the best without a term that wanders, if there is one.
  [[nodiscard]] const std::optional<DeterministicDrift<Scalar>>& drift() const { return drift_; }

  /// Whether every description has it. A Gauss–Markov bias that forgets more slowly than the log can show is a walk:
  /// that it forgets must gain what its time costs.
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

  /// Whether the first can do what the second does: it has its terms, or what tends to a walk.
  [[nodiscard]] static bool covers(NoiseTerms terms, NoiseTerms others) {
    if (terms.has(NoiseTerm::gauss_markov)) others = others.without(NoiseTerm::random_walk);
    return others.within(terms);
  }

  [[nodiscard]] static unsigned count(NoiseTerms terms) {
    unsigned sum = 0;
    for (const NoiseTerm term : noise_terms) sum += terms.has(term) ? 1 : 0;
    return sum;
  }

  /// Models have one or two of the slow terms, or walk, flicker and a trend; and white noise unless what they have else
  /// is simple. More could hardly be told from these.
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

  /// A mean besides the white and quantization noise of the best model.
  void look_for_drift() {
    using enum NoiseTerm;
    using Fit = SpectralFit<Scalar>;
    const Fit& fit = likelihood_.fit();
    const Model& best = models_.front();
    const NoiseTerms slow = best.terms.without(white).without(quantization);
    const bool still = std::any_of(models_.begin(), models_.end(), [&](const Model& model) {
      return plausible(model) && model.terms.within(NoiseTerms{white, quantization});
    });
    if (still) return;  // nothing slow is claimed
    // Who names no drift among the candidates knows that there is none.
    if (slow.empty() || !best.terms.has(white) || !(candidates_.has(rate_ramp) || candidates_.has(warm_up))) return;
    std::vector<Scalar> expected;
    const auto& theta = best.result.theta;
    for (const auto& bin : fit.spectrum().bins()) {
      Scalar power = 0;
      for (const NoiseTerm term : {white, quantization}) power += bin.basis[Fit::place(term)] * theta[Fit::place(term)];
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
    // One whose time gains nothing is a ramp.
    if (terms.has(NoiseTerm::warm_up)) {
      const NoiseTerms ramp = terms.without(NoiseTerm::warm_up).with(NoiseTerm::rate_ramp);
      const bool idle = std::any_of(models_.begin(), models_.end(), [&](const Model& model) {
        return model.terms == ramp && model.result.objective - result.objective < price;
      });
      // Without a ramp among the candidates, one that does not settle within the log.
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

}  // namespace splinertia::allan
