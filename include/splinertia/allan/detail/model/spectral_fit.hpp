// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <splinertia/allan/detail/grouped_spectrum.hpp>
#include <splinertia/allan/detail/model/non_negative_solution.hpp>
#include <splinertia/allan/detail/pooled_spectrum.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/fixed_array.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan::detail {

/// Maximum-likelihood fit of noise terms to the bins of a spectrum.
///
/// The b_k of a spectrum are independent and Gaussian with mean square S_k = Σ θ_j·basis_jk: exactly for white noise
/// and random walk, for the other terms except for a correlation of neighbouring bins. The fit minimises
/// Σ log S_k + (b_k − c w_k)²/S_k with c the slope of a trend. For given S this is linear least squares; repeated with
/// the S found it is Fisher scoring (McCullagh and Nelder, "Generalized Linear Models", 2.5), here with θ ≥ 0.
template <typename Scalar>
class SpectralFit {
 public:
  using Spectrum = PooledSpectrum<Scalar>;
  /// White noise, random walk, bias instability, quantization, Gauss–Markov.
  static constexpr int powers = Spectrum::powers + 1;
  using Vector = Eigen::Matrix<Scalar, powers, 1>;
  using Matrix = Eigen::Matrix<Scalar, powers, powers>;

  /// The terms that have a component of θ.
  static constexpr splinertia::detail::FixedArray<NoiseTerm, powers> spectral_terms{
      NoiseTerm::white, NoiseTerm::random_walk, NoiseTerm::bias_instability, NoiseTerm::quantization,
      NoiseTerm::gauss_markov};
  /// The index of a term in θ.
  [[nodiscard]] static constexpr int index_of(NoiseTerm term) {
    return term == NoiseTerm::gauss_markov ? powers - 1 : static_cast<int>(term);
  }

  /// The time constants of a model.
  struct Times {
    Scalar correlation{};                                    ///< of the Gauss–Markov bias, s
    Scalar decay = std::numeric_limits<Scalar>::infinity();  ///< of the trend, s; infinite: a ramp
  };

  struct Result {
    Vector theta = Vector::Zero();  ///< N²·rate, K²/rate, B², Q²·rate², and 2σ²/(T·rate) of Gauss–Markov; unit()²
    Scalar objective = (std::numeric_limits<Scalar>::max)();  ///< −2·log-likelihood up to a constant
    std::vector<Scalar> slopes;  ///< of each spectrum at its beginning, unit() per sample; zero without a trend
    Scalar slope_error{};        ///< standard error of a slope; zero without a trend
    Times times{};
  };

  /// Fits the included bins. Each counts as at most `most_count` of b_k, which limits its weight.
  SpectralFit(std::reference_wrapper<const Spectrum> spectrum, const std::vector<bool>& included,
              Scalar most_count = (std::numeric_limits<Scalar>::max)())
      : spectrum_(&spectrum.get()), included_(included), grouped_(spectrum, included, most_count) {}

  [[nodiscard]] const Spectrum& spectrum() const { return *spectrum_; }
  [[nodiscard]] const std::vector<bool>& included() const { return included_; }
  /// The smallest S_k, in unit()²: the squared rounding error of the largest sample. It keeps the likelihood finite for
  /// a signal that is a ramp to the last digit.
  [[nodiscard]] static Scalar floor() {
    return std::numeric_limits<Scalar>::epsilon() * std::numeric_limits<Scalar>::epsilon();
  }
  /// The number of groups of bins. Each group has one expected power.
  [[nodiscard]] std::size_t groups() const { return grouped_.groups.size(); }

  /// Mean square of b_k at a bin with basis_0 = x for a Gauss–Markov bias with 2σ²/(T·rate) = 1, where a random walk
  /// has 1: x·(1 − φ²)/(2a)/((1 − φ)² + φx), a = 1/(T·rate), φ = e^(−a).
  [[nodiscard]] Scalar gauss_markov_basis(Scalar x, Scalar correlation_time) const {
    const Scalar step = 1 / (spectrum_->rate() * correlation_time), keep = std::exp(-step), lost = -std::expm1(-step);
    return x * (lost * (1 + keep) / (2 * step)) / (lost * lost + keep * x);
  }

  struct Fixed {
    NoiseTerm term;
    Scalar theta;
  };

  /// The most likely coefficients of a model with these times. The search starts from `start`, by default from a
  /// smoothed spectrum, and ends with a step that gains less than `least_gain`. `fixed` holds one coefficient at a
  /// value. With several terms the likelihood can have more than one maximum, most of them far from the truth.
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
      if (fixed) best.theta[index_of(fixed->term)] = fixed->theta;
    } else {
      expected = smooth();
      if (work.trend) fit_slopes(work, expected, best);
      best.theta = step(work, terms, fixed, expected, best.slopes);
    }
    best.objective = evaluate(work, best, expected);
    for (int i = 0; i < most_steps; ++i) {
      const Vector next = step(work, terms, fixed, expected, best.slopes);
      // Line search: a full step may overshoot the maximum. If the model does not describe the signal, it may end as
      // far from the maximum on the other side.
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
          // Next to the maximum, scoring converges with full steps.
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

  /// −2·log-likelihood of white and quantization noise alone, with their coefficients in θ.
  [[nodiscard]] Scalar fast_objective(const Vector& theta) const {
    const NoiseTerms fast{NoiseTerm::white, NoiseTerm::quantization};
    const Work work = prepare(fast, {});
    const Column expected = expect(work, theta.cwiseProduct(mask(fast)));
    return (grouped_.count * expected.log() + grouped_.power / expected).sum();
  }

  /// Expected and observed power of a bin. The trend is subtracted from the observed power.
  struct Comparison {
    Scalar expected, residual, white;  ///< of one b_k; observed, of all b_k; of one b_k, white noise alone
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

  /// 1 for the terms of a model, 0 for the others.
  [[nodiscard]] static Vector mask(NoiseTerms terms) {
    Vector mask = Vector::Zero();
    for (const NoiseTerm term : spectral_terms) mask[index_of(term)] = terms.has(term) ? Scalar(1) : Scalar(0);
    return mask;
  }

  [[nodiscard]] TrendBin trend_of(std::size_t i, Scalar decay_time) const {
    const auto& bin = spectrum_->bins()[i];
    if (!splinertia::detail::is_finite(decay_time)) return {0, 0, bin.ramp_square, true};
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

  /// First guess of S: means over a third of an octave around each group.
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

  /// Least-squares slopes of the trends. All have the same standard error, because they share S.
  void fit_slopes(const Work& work, const Column& expected, Result& result) const {
    const Scalar information = (work.trend_square / expected).sum();
    for (std::size_t a = 0; a < work.trend_products.size(); ++a) {
      result.slopes[a] = information > 0 ? (work.trend_products[a] / expected).sum() / information : Scalar(0);
    }
    result.slope_error = information > 0 ? 1 / std::sqrt(information) : std::numeric_limits<Scalar>::infinity();
  }

  /// The objective at trial.theta with the best slopes for it. Sets these slopes and `expected`.
  [[nodiscard]] Scalar evaluate(const Work& work, Result& trial, Column& expected) const {
    expected = expect(work, trial.theta);
    if (work.trend) fit_slopes(work, expected, trial);
    return (grouped_.count * expected.log() + residual_power(work, trial.slopes) / expected).sum();
  }

  /// Weighted least squares of the power with θ ≥ 0 and the variance 2S² of the model.
  [[nodiscard]] Vector step(const Work& work, NoiseTerms terms, const std::optional<Fixed>& fixed,
                            const Column& expected, const std::vector<Scalar>& slopes) const {
    const Column weight = expected.square().inverse();
    const auto basis = work.basis.matrix();
    const Matrix information = basis.transpose() * (grouped_.count * weight).matrix().asDiagonal() * basis;
    const Vector product = basis.transpose() * (residual_power(work, slopes) * weight).matrix();
    Vector fixed_part = Vector::Zero();
    unsigned candidates = 0;
    for (const NoiseTerm term : spectral_terms) {
      if (fixed && fixed->term == term) {
        fixed_part[index_of(term)] = fixed->theta;
      } else if (terms.has(term)) {
        candidates |= 1u << index_of(term);
      }
    }
    return fixed_part +
           non_negative_solution<Scalar, powers>(information, product - information * fixed_part, candidates);
  }

  const Spectrum* spectrum_;
  std::vector<bool> included_;
  GroupedSpectrum<Scalar> grouped_;
};

}  // namespace splinertia::allan::detail
