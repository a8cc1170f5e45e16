// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <splinertia/allan/detail/model/spectral_fit.hpp>
#include <splinertia/allan/interval.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/finite.hpp>

namespace splinertia::allan::detail {

/// The most likely model with a set of terms: SpectralFit for the coefficients, and a search over the times of a
/// Gauss–Markov bias and a warm-up.
template <typename Scalar>
class ModelLikelihood {
 public:
  using Fit = SpectralFit<Scalar>;
  using Result = typename Fit::Result;
  using Times = typename Fit::Times;
  using Fixed = typename Fit::Fixed;

  explicit ModelLikelihood(std::reference_wrapper<const Fit> fit) : fit_(fit) {
    const auto& spectrum = fit_.spectrum();
    const Scalar samples = static_cast<Scalar>(spectrum.samples()), rate = spectrum.rate();
    // Correlation times below 32 samples are those of the sensor's filter; below a ten-thousandth of the log, of
    // vibration.
    correlation_ = {(std::max)(Scalar(32), samples / 10000) / rate, (std::max)(Scalar(64), samples / 4) / rate};
    decay_ = {(std::max)(Scalar(32), samples / 200) / rate, (std::max)(Scalar(64), 8 * samples) / rate};
  }

  /// The better of a search from scratch and one from a `simpler` model with fewer terms, so that more terms are never
  /// less likely.
  [[nodiscard]] Result maximise(NoiseTerms terms, const Result* simpler = nullptr) const {
    Result best = search(terms);
    if (simpler != nullptr) {
      Result other = maximum_near(terms, *simpler);
      if (other.objective < best.objective) best = std::move(other);
    }
    return best;
  }

  /// Searches from a nearby result. `fixed` says which coefficient to hold at given times: a Fixed, or nothing.
  template <typename FixedAt>
  [[nodiscard]] Result maximum_near(NoiseTerms terms, const Result& start, const FixedAt& fixed) const {
    const bool correlated = terms.has(NoiseTerm::gauss_markov), has_decay = terms.has(NoiseTerm::warm_up);
    Times times = start.times;
    if (!has_decay) times.decay = infinity;
    if (has_decay && !splinertia::detail::is_finite(times.decay)) times.decay = decay_.upper;
    if (correlated && !(times.correlation > 0)) times.correlation = correlation_.upper;
    Result best = fit_.maximise(terms, times, fixed(times), &start.theta);
    for (int round = 0; round < (correlated && has_decay ? 2 : 1); ++round) {
      if (correlated) refine(terms, fixed, best, &Times::correlation, correlation_);
      if (has_decay) refine(terms, fixed, best, &Times::decay, decay_);
    }
    return best;
  }

  [[nodiscard]] Result maximum_near(NoiseTerms terms, const Result& start) const {
    return maximum_near(terms, start, [](const Times&) { return std::optional<Fixed>(); });
  }

  /// The most likely model with these times.
  [[nodiscard]] Result at(NoiseTerms terms, const Times& times, const Result& start) const {
    return fit_.maximise(terms, times, {}, &start.theta);
  }

  [[nodiscard]] const Fit& fit() const { return fit_; }
  [[nodiscard]] const Interval<Scalar>& correlation_times() const { return correlation_; }
  [[nodiscard]] const Interval<Scalar>& decay_times() const { return decay_; }

 private:
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();

  [[nodiscard]] Result search(NoiseTerms terms) const {
    const bool correlated = terms.has(NoiseTerm::gauss_markov), has_decay = terms.has(NoiseTerm::warm_up);
    if (!correlated && !has_decay) return fit_.maximise(terms);
    const Scalar factor = correlated && has_decay ? Scalar(4) : Scalar(2);
    const Scalar coarse = Scalar(1) / 100;
    Result best;
    for (Scalar decay = has_decay ? decay_.lower : infinity;; decay *= factor) {
      Result last;
      for (Scalar correlation = correlated ? correlation_.lower : Scalar(0);; correlation *= factor) {
        last = fit_.maximise(terms, {correlation, decay}, {}, last.slopes.empty() ? nullptr : &last.theta, coarse);
        if (last.objective < best.objective) best = last;
        if (!correlated || correlation * factor > correlation_.upper) break;
      }
      if (!has_decay || decay * factor > decay_.upper) break;
    }
    return maximum_near(terms, best);
  }

  /// Optimises one time: steps by a factor of 4/3 until the likelihood falls, then a parabola through three points.
  template <typename FixedAt>
  void refine(NoiseTerms terms, const FixedAt& fixed, Result& best, Scalar Times::*time,
              const Interval<Scalar>& range) const {
    const auto at = [&](Scalar value) {
      Times times = best.times;
      times.*time = std::clamp(value, range.lower, range.upper);
      return fit_.maximise(terms, times, fixed(times), &best.theta);
    };
    Scalar width = Scalar(4) / 3;
    Result shorter = at(best.times.*time / width), longer = at(best.times.*time * width);
    for (int i = 0; i < 24 && (std::min)(shorter.objective, longer.objective) < best.objective; ++i) {
      const bool up = longer.objective < shorter.objective;
      Result& behind = up ? shorter : longer;
      Result& ahead = up ? longer : shorter;
      behind = std::move(best);
      best = ahead;
      ahead = at(up ? best.times.*time * width : best.times.*time / width);
    }
    for (int i = 0; i < 2; ++i) {
      const Scalar left = shorter.objective - best.objective, right = longer.objective - best.objective;
      const Scalar x0 = std::log(shorter.times.*time / (best.times.*time)),
                   x1 = std::log(longer.times.*time / (best.times.*time));
      if (!(x0 < 0) || !(x1 > 0) || !(left + right > Scalar(1e-6))) return;
      const Scalar vertex = (left * x1 * x1 - right * x0 * x0) / (2 * (left * x1 - right * x0));
      if (!(vertex > x0) || !(vertex < x1)) return;
      Result middle = at(best.times.*time * std::exp(vertex));
      if (middle.objective >= best.objective) return;
      (vertex < 0 ? longer : shorter) = std::move(best);
      best = std::move(middle);
    }
  }

  const Fit& fit_;
  Interval<Scalar> correlation_, decay_;
};

}  // namespace splinertia::allan::detail
