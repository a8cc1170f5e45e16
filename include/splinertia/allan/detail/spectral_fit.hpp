// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <splinertia/allan/detail/grouped_spectrum.hpp>
#include <splinertia/allan/detail/non_negative_solution.hpp>
#include <splinertia/allan/detail/pooled_spectrum.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/fixed_array.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan {

/// Maximum likelihood of noise terms in the bins of a spectrum.
///
/// The b_k of a spectrum are Gaussian with mean square S_k = Σ θ_j·basis_jk and independent: exactly so for white noise
/// and random walk, but for what is common to neighbouring bins also for the other terms. To maximise is to minimise
/// Σ log S_k + (b_k − c w_k)²/S_k, c the slope of a trend. For given S this is linear least squares; repeated with
/// the S found it is Fisher's scoring (McCullagh and Nelder, "Generalized Linear Models", 2.5), here with θ ≥ 0.
template <typename Scalar>
class SpectralFit {
 public:
  using Spectrum = PooledSpectrum<Scalar>;
  /// White noise, random walk, bias instability, quantization, Gauss–Markov.
  static constexpr int powers = Spectrum::powers + 1;
  using Vector = Eigen::Matrix<Scalar, powers, 1>;
  using Matrix = Eigen::Matrix<Scalar, powers, powers>;

  /// The terms that have a place in θ.
  static constexpr FixedArray<NoiseTerm, powers> spectral_terms{NoiseTerm::white, NoiseTerm::random_walk,
                                                                NoiseTerm::bias_instability, NoiseTerm::quantization,
                                                                NoiseTerm::gauss_markov};
  /// The place of a term in θ.
  [[nodiscard]] static constexpr int place(NoiseTerm term) {
    return term == NoiseTerm::gauss_markov ? powers - 1 : static_cast<int>(term);
  }

  /// What a model has besides coefficients.
  struct Times {
    Scalar correlation{};                                    ///< of the Gauss–Markov bias, s
    Scalar decay = std::numeric_limits<Scalar>::infinity();  ///< of the trend, s; infinite: a ramp
  };

  struct Result {
    Vector theta = Vector::Zero();  ///< N²·rate, K²/rate, B², Q²·rate², and 2σ²/(T·rate) of Gauss–Markov; unit()²
    Scalar objective = (std::numeric_limits<Scalar>::max)();  ///< −2·log-likelihood, but for a constant
    std::vector<Scalar> slopes;  ///< of each spectrum at its beginning, unit() a sample; zero if the model has no trend
    Scalar slope_error{};        ///< standard error of a slope; zero if the model has no trend
    Times times{};
  };

  /// Of the bins that are included. A bin counts as at most `most_count` of b_k, so that none has more to say.
  SpectralFit(std::reference_wrapper<const Spectrum> spectrum, const std::vector<bool>& included,
              Scalar most_count = (std::numeric_limits<Scalar>::max)())
      : spectrum_(&spectrum.get()), included_(included), grouped_(spectrum, included, most_count) {}

  [[nodiscard]] const Spectrum& spectrum() const { return *spectrum_; }
  [[nodiscard]] const std::vector<bool>& included() const { return included_; }
  /// The least S_k, in unit()²: the rounding of the largest sample. Without it, a signal that a ramp describes to the
  /// last digit would have no likelihood.
  [[nodiscard]] static Scalar floor() {
    return std::numeric_limits<Scalar>::epsilon() * std::numeric_limits<Scalar>::epsilon();
  }
  /// Groups of bins, each with one expected power.
  [[nodiscard]] std::size_t groups() const { return grouped_.groups.size(); }

  /// What the square of a Gauss–Markov bias of 2σ²/(T·rate) = 1 has at a bin with basis_0 = x: a random walk's 1 times
  /// x·(1 − φ²)/(2a)/((1 − φ)² + φx), a = 1/(T·rate), φ = e^(−a).
  [[nodiscard]] Scalar gauss_markov_basis(Scalar x, Scalar correlation_time) const {
    const Scalar step = 1 / (spectrum_->rate() * correlation_time), keep = std::exp(-step), lost = -std::expm1(-step);
    return x * (lost * (1 + keep) / (2 * step)) / (lost * lost + keep * x);
  }

  struct Fixed {
    NoiseTerm term;
    Scalar theta;
  };

  /// The most likely coefficients of a model with these times near `start`, by default a smoothed spectrum; `fixed`
  /// holds one of them at a value. With several terms the likelihood can have more than one maximum, mostly far from
  /// the truth. Steps that gain less than `least_gain` end the search.
  [[nodiscard]] Result maximise(NoiseTerms terms, const Times& times = {}, const std::optional<Fixed>& fixed = {},
                                const Vector* start = nullptr, Scalar least_gain = Scalar(1e-9)) const {
    constexpr int most_steps = 60;
    const Work work = prepare(terms, times);
    Result best;
    best.times = times;
    best.slopes.assign(spectrum_->spectra(), Scalar(0));
    Column expected;
    if (start != nullptr) {
      best.theta = start->cwiseProduct(mask(terms));
      if (fixed) best.theta[place(fixed->term)] = fixed->theta;
    } else {
      expected = smooth();
      if (work.trend) fit_slopes(work, expected, best);
      best.theta = step(work, terms, fixed, expected, best.slopes);
    }
    best.objective = evaluate(work, best, expected);
    for (int i = 0; i < most_steps; ++i) {
      const Vector next = step(work, terms, fixed, expected, best.slopes);
      // Towards it as far as that is best: a full step may pass over the top and, of a model that does not describe the
      // signal, end as far from it on the other side.
      Scalar gain = 0;
      Result further = best;
      for (Scalar share = 1; share > Scalar(1e-3); share /= 2) {
        Result trial = best;
        trial.theta = best.theta + share * (next - best.theta);
        trial.objective = evaluate(work, trial, expected);
        if (best.objective - trial.objective > gain) {
          const bool whole = share == 1;
          gain = best.objective - trial.objective;
          further = std::move(trial);
          // Scoring converges by whole steps next to the top.
          if (whole && gain < 1) break;
        } else if (gain > 0) {
          break;
        }
      }
      best = std::move(further);
      if (gain < least_gain) break;
      expected = expect(work, best.theta);
    }
    return best;
  }

  /// −2·log-likelihood of white and quantization noise alone, with the coefficients of a θ that has more.
  [[nodiscard]] Scalar fast_objective(const Vector& theta) const {
    const NoiseTerms fast{NoiseTerm::white, NoiseTerm::quantization};
    const Work work = prepare(fast, {});
    const Column expected = expect(work, theta.cwiseProduct(mask(fast)));
    return (grouped_.count * expected.log() + grouped_.power / expected).sum();
  }

  /// The power expected in a bin of the spectrum, for each b_k, and what is there without the trend.
  struct Comparison {
    Scalar expected, residual, white;  ///< of one b_k; of all; of one, white noise alone
  };
  [[nodiscard]] std::vector<Comparison> compare(const Result& result, bool trend) const {
    std::vector<Comparison> all;
    const auto& bins = spectrum_->bins();
    all.reserve(bins.size());
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const auto& bin = bins[i];
      Scalar expected = bin.basis.dot(result.theta.template head<Spectrum::powers>());
      if (result.theta[powers - 1] > 0) {
        expected += result.theta[powers - 1] * gauss_markov_basis(bin.basis[0], result.times.correlation);
      }
      Scalar residual = bin.power;
      if (trend) {
        const TrendBin sums = trend_of(i, result.times.decay);
        for (std::size_t a = 0; a < result.slopes.size(); ++a) {
          residual += result.slopes[a] * (result.slopes[a] * sums.square - 2 * product_of(i, a, sums));
        }
      }
      all.push_back({(std::max)(expected, floor()), (std::max)(residual, Scalar(0)), bin.basis[0] * result.theta[0]});
    }
    return all;
  }

 private:
  using Column = typename GroupedSpectrum<Scalar>::Column;
  struct Work {
    Eigen::Array<Scalar, Eigen::Dynamic, powers> basis;
    bool trend = false;
    Column trend_square;
    std::vector<Column> trend_products;  // of each spectrum
  };
  struct TrendBin {
    Scalar odd, even, square;
    bool ramp;
  };

  /// One for the terms that a model has.
  [[nodiscard]] static Vector mask(NoiseTerms terms) {
    Vector mask = Vector::Zero();
    for (const NoiseTerm term : spectral_terms) mask[place(term)] = terms.has(term) ? Scalar(1) : Scalar(0);
    return mask;
  }

  [[nodiscard]] TrendBin trend_of(std::size_t i, Scalar decay_time) const {
    const auto& bin = spectrum_->bins()[i];
    if (!is_finite(decay_time)) return {0, 0, bin.ramp_square, true};
    const auto means = spectrum_->trend_means(bin, decay_time);
    return {means.odd, means.even, bin.odd_count * means.odd * means.odd + bin.even_count * means.even * means.even,
            false};
  }
  [[nodiscard]] Scalar product_of(std::size_t i, std::size_t a, const TrendBin& trend) const {
    const auto& sums = spectrum_->trend_sums()[a][i];
    return trend.ramp ? sums.ramp_product : trend.odd * sums.odd + trend.even * sums.even;
  }

  [[nodiscard]] Work prepare(NoiseTerms terms, const Times& times) const {
    Work work;
    work.basis.setZero(grouped_.basis.rows(), powers);
    work.basis.template leftCols<Spectrum::powers>() = grouped_.basis;
    if (terms.has(NoiseTerm::gauss_markov)) {
      for (Eigen::Index g = 0; g < grouped_.basis.rows(); ++g) {
        work.basis(g, powers - 1) = gauss_markov_basis(grouped_.basis(g, 0), times.correlation);
      }
    }
    work.trend = terms.has(NoiseTerm::rate_ramp) || terms.has(NoiseTerm::warm_up);
    if (!work.trend) return work;
    work.trend_square.setZero(grouped_.basis.rows());
    work.trend_products.assign(spectrum_->spectra(), Column::Zero(grouped_.basis.rows()));
    for (Eigen::Index g = 0; g < grouped_.basis.rows(); ++g) {
      for (std::size_t i = grouped_.group(g).begin; i < grouped_.group(g).end; ++i) {
        const TrendBin trend = trend_of(i, times.decay);
        work.trend_square[g] += trend.square * grouped_.share[g];
        for (std::size_t a = 0; a < work.trend_products.size(); ++a) {
          work.trend_products[a][g] += product_of(i, a, trend) * grouped_.share[g];
        }
      }
    }
    return work;
  }

  [[nodiscard]] Column residual_power(const Work& work, const std::vector<Scalar>& slopes) const {
    if (!work.trend) return grouped_.power;
    Column power = grouped_.power;
    for (std::size_t a = 0; a < slopes.size(); ++a) {
      power += slopes[a] * (slopes[a] * work.trend_square - 2 * work.trend_products[a]);
    }
    return (power.max)(Scalar(0));
  }

  [[nodiscard]] Column expect(const Work& work, const Vector& theta) const {
    return ((work.basis.matrix() * theta).array().max)(floor());
  }

  /// A first guess of S: means over a third of an octave about each group.
  [[nodiscard]] Column smooth() const {
    Column expected(grouped_.count.size());
    Eigen::Index begin = 0, end = 0;
    Scalar power = 0, count = 0;
    for (Eigen::Index g = 0; g < grouped_.count.size(); ++g) {
      while (end < grouped_.count.size() &&
             (end < g + 4 || grouped_.frequency[end] < grouped_.frequency[g] * Scalar(1.125))) {
        power += grouped_.power[end];
        count += grouped_.count[end];
        ++end;
      }
      while (begin + 4 < g && grouped_.frequency[begin] * Scalar(1.125) < grouped_.frequency[g]) {
        power -= grouped_.power[begin];
        count -= grouped_.count[begin];
        ++begin;
      }
      expected[g] = (std::max)(power / count, floor());
    }
    return expected;
  }

  /// Least squares for the slopes of the trends: the same standard error for all, since they share S.
  void fit_slopes(const Work& work, const Column& expected, Result& result) const {
    const Scalar information = (work.trend_square / expected).sum();
    for (std::size_t a = 0; a < work.trend_products.size(); ++a) {
      result.slopes[a] = information > 0 ? (work.trend_products[a] / expected).sum() / information : Scalar(0);
    }
    result.slope_error = information > 0 ? 1 / std::sqrt(information) : std::numeric_limits<Scalar>::infinity();
  }

  /// The objective at trial.theta with the best slopes for it, which it sets, as it does `expected`.
  [[nodiscard]] Scalar evaluate(const Work& work, Result& trial, Column& expected) const {
    expected = expect(work, trial.theta);
    if (work.trend) fit_slopes(work, expected, trial);
    return (grouped_.count * expected.log() + residual_power(work, trial.slopes) / expected).sum();
  }

  /// Weighted least squares of the power for θ ≥ 0, with the variance 2S² of the model.
  [[nodiscard]] Vector step(const Work& work, NoiseTerms terms, const std::optional<Fixed>& fixed,
                            const Column& expected, const std::vector<Scalar>& slopes) const {
    const Column weight = expected.square().inverse();
    const auto basis = work.basis.matrix();
    const Matrix information = basis.transpose() * (grouped_.count * weight).matrix().asDiagonal() * basis;
    const Vector product = basis.transpose() * (residual_power(work, slopes) * weight).matrix();
    Vector held = Vector::Zero();
    unsigned candidates = 0;
    for (const NoiseTerm term : spectral_terms) {
      if (fixed && fixed->term == term) {
        held[place(term)] = fixed->theta;
      } else if (terms.has(term)) {
        candidates |= 1u << place(term);
      }
    }
    return held + non_negative_solution<Scalar, powers>(information, product - information * held, candidates);
  }

  const Spectrum* spectrum_;
  std::vector<bool> included_;
  GroupedSpectrum<Scalar> grouped_;
};

}  // namespace splinertia::allan
