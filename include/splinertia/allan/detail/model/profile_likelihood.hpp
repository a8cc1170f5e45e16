// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/model/model_likelihood.hpp>
#include <splinertia/allan/interval.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/finite.hpp>
#include <utility>

namespace splinertia::allan::detail {

/// Widens an interval to include another one. An interval that ends at zero is not set yet.
template <typename Scalar>
void widen(Interval<Scalar>& whole, const Interval<Scalar>& more) {
  if (whole.upper == 0) {
    whole = more;
  } else {
    whole = {(std::min)(whole.lower, more.lower), (std::max)(whole.upper, more.upper)};
  }
}

/// Profile-likelihood intervals of one description of a log. At their ends −2·log-likelihood, minimised over all other
/// parameters, is `drop` above its minimum. Their level is the same for any function of a parameter (Wilks).
template <typename Scalar>
class ProfileLikelihood {
 public:
  using Likelihood = ModelLikelihood<Scalar>;
  using Result = typename Likelihood::Result;
  using Fixed = typename Likelihood::Fixed;
  using Times = typename Likelihood::Times;

  ProfileLikelihood(std::reference_wrapper<const Likelihood> likelihood, NoiseTerms terms, Result best)
      : likelihood_(likelihood), terms_(terms), best_(std::move(best)) {}

  /// The interval of √θ of a term that has a component of θ.
  [[nodiscard]] Interval<Scalar> root(NoiseTerm term, Scalar confidence) const {
    const Scalar centre = std::sqrt(best_.theta[Likelihood::Fit::index_of(term)]);
    const auto fixing = [term](Scalar root) {
      return [term, root](const Times&) { return std::optional<Fixed>({term, root * root}); };
    };
    return interval(centre, confidence, fixing);
  }

  /// The interval of σ·√(2/rate) of a Gauss–Markov bias with standard deviation σ, in unit()·√s. 2σ²/rate is the
  /// correlation time times θ.
  [[nodiscard]] Interval<Scalar> gauss_markov_root(Scalar confidence) const {
    const Scalar centre =
        std::sqrt(best_.theta[Likelihood::Fit::index_of(NoiseTerm::gauss_markov)] * best_.times.correlation);
    const auto fixing = [](Scalar root) {
      return [root](const Times& times) {
        return std::optional<Fixed>({NoiseTerm::gauss_markov, root * root / times.correlation});
      };
    };
    return interval(centre, confidence, fixing);
  }

  /// The interval of one of the times, within its range. The search is on a logarithmic scale.
  [[nodiscard]] Interval<Scalar> time(Scalar Times::*time, const Interval<Scalar>& range, Scalar confidence) const {
    const Scalar drop = chi_square_quantile(confidence, Scalar(1));
    const auto end = [&](Scalar limit) {
      Result start = best_;
      const auto excess = [&](Scalar value) {
        Times times = best_.times;
        times.*time = std::exp(value);
        start = likelihood_.at(terms_, times, start);
        return start.objective - best_.objective;
      };
      const Scalar centre = std::log(best_.times.*time), last = std::log(limit);
      if (excess(last) <= drop) return limit;
      start = best_;
      return std::exp(crossing(excess, centre, last, drop));
    };
    return {end(range.lower), end(range.upper)};
  }

 private:
  template <typename Fixing>
  [[nodiscard]] Interval<Scalar> interval(Scalar centre, Scalar confidence, const Fixing& fixing) const {
    const Scalar drop = chi_square_quantile(confidence, Scalar(1));
    // A root with the squared relative error e² is like a scale estimated from 1/(2e²) degrees of freedom. With few of
    // them the likelihood ratio is larger by the factor 1 + 2e²/3 (Bartlett, Proc. R. Soc. A 160 (1937)).
    const Scalar share = centre > 0 ? end(centre, fixing, Scalar(1), true) / centre - 1 : Scalar(1);
    const Scalar error = (std::min)(share * share, Scalar(1) / 2);
    const Scalar corrected = drop * (1 + 2 * error / 3);
    return {end(centre, fixing, corrected, false), end(centre, fixing, corrected, true)};
  }

  template <typename Fixing>
  [[nodiscard]] Scalar end(Scalar centre, const Fixing& fixing, Scalar drop, bool above) const {
    Result start = best_;
    const auto excess = [&](Scalar root) {
      start = likelihood_.maximum_near(terms_, start, fixing(root));
      return start.objective - best_.objective;
    };
    Scalar outside = 0;
    if (above) {
      // The first step is a share of the value, or of the root of all power.
      const Scalar whole = std::sqrt((std::max)(best_.theta.sum(), Likelihood::Fit::floor()));
      Scalar reach = (std::max)(centre / 8, whole / 1'000'000);
      Scalar inside = centre;
      outside = centre + reach;
      while (excess(outside) < drop) {
        inside = outside;
        reach *= 2;
        outside = centre + reach;
        if (!splinertia::detail::is_finite(outside)) return outside;  // the log says nothing of this parameter
      }
      return crossing(excess, inside, outside, drop);
    }
    if (excess(Scalar(0)) <= drop) return Scalar(0);
    start = best_;
    return crossing(excess, centre, outside, drop);
  }

  /// Where the excess crosses `drop`: it is below at `inside` and above at `outside`. The root of the excess is nearly
  /// linear. Regula falsi (Illinois), with every fourth step a bisection, to 1e-5 of the distance.
  template <typename Excess>
  [[nodiscard]] static Scalar crossing(const Excess& excess, Scalar inside, Scalar outside, Scalar drop) {
    const Scalar goal = std::sqrt(drop);
    const auto off = [&](Scalar value) { return std::sqrt((std::max)(excess(value), Scalar(0))) - goal; };
    const Scalar centre = inside;
    Scalar below = off(inside), above = off(outside);
    if (!(below < 0)) return inside;
    if (!(above > 0)) return outside;
    int side = 0;
    for (int i = 0; i < 40; ++i) {
      const Scalar width = outside - inside;
      if (std::abs(width) <= std::abs(inside - centre) * Scalar(1e-5)) break;
      const bool halve = i % 4 == 3;
      const Scalar middle = halve ? inside + width / 2 : inside - width * below / (above - below);
      const Scalar there = off(middle);
      if (std::abs(there) < goal * Scalar(1e-6)) return middle;
      if (there < 0) {
        inside = middle;
        below = there;
        if (side < 0) above /= 2;
        side = -1;
      } else {
        outside = middle;
        above = there;
        if (side > 0) below /= 2;
        side = 1;
      }
    }
    return (inside + outside) / 2;
  }

  const Likelihood& likelihood_;
  NoiseTerms terms_;
  Result best_;
};

}  // namespace splinertia::allan::detail
