// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <splinertia/allan/difference_spectrum.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/allan/non_negative_solution.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan {

/// Which of the terms a model has.
class NoiseTerms {
 public:
  constexpr NoiseTerms() = default;
  constexpr NoiseTerms(std::initializer_list<NoiseTerm> terms) {
    for (const NoiseTerm term : terms) bits_ |= bit(term);
  }
  static constexpr unsigned sets = 32;
  [[nodiscard]] static constexpr NoiseTerms all() { return numbered(sets - 1); }
  /// One of 0 … sets − 1, each another set.
  [[nodiscard]] static constexpr NoiseTerms numbered(unsigned bits) {
    NoiseTerms result;
    result.bits_ = bits;
    return result;
  }
  [[nodiscard]] constexpr unsigned number() const { return bits_; }
  [[nodiscard]] constexpr bool has(NoiseTerm term) const { return (bits_ & bit(term)) != 0; }
  [[nodiscard]] constexpr NoiseTerms with(NoiseTerm term) const { return numbered(bits_ | bit(term)); }
  [[nodiscard]] constexpr NoiseTerms without(NoiseTerm term) const { return numbered(bits_ & ~bit(term)); }
  [[nodiscard]] constexpr bool within(NoiseTerms other) const { return (bits_ & ~other.bits_) == 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool operator==(const NoiseTerms&) const = default;

 private:
  [[nodiscard]] static constexpr unsigned bit(NoiseTerm term) { return 1u << static_cast<unsigned>(term); }
  unsigned bits_ = 0;
};

/// Maximum likelihood of noise terms, from the spectra of one signal's differences or of several that share them.
///
/// The b_k of a spectrum are Gaussian with mean square S_k = Σ θ_j·basis_jk and independent: exactly so for white noise
/// and random walk, but for what is common to neighbouring bins also for the other terms. To maximise is to minimise
/// Σ log S_k + (b_k − c w_k)²/S_k, c the slope of a rate ramp. For given S this is linear least squares; repeated with
/// the S found it is Fisher's scoring (McCullagh and Nelder, "Generalized Linear Models", 2.5), here with θ ≥ 0.
template <typename Scalar>
class SpectralFit {
 public:
  static constexpr int powers = DifferenceSpectrum<Scalar>::powers;
  using Vector = Eigen::Matrix<Scalar, powers, 1>;
  using Matrix = Eigen::Matrix<Scalar, powers, powers>;

  struct Result {
    Vector theta;                ///< powers of white noise, random walk, bias instability, quantization; unit()²
    Scalar objective;            ///< −2·log-likelihood, but for a constant
    std::vector<Scalar> slopes;  ///< of each spectrum, unit() a sample; zero if the model has no ramp
    Scalar slope_error{};        ///< standard error of a slope; zero if the model has no ramp
  };

  /// Of spectra with the same rate and length; frequencies above `highest` [Hz] are left out.
  SpectralFit(std::span<const DifferenceSpectrum<Scalar>> spectra, Scalar highest) : unit_(0) {
    for (const auto& spectrum : spectra) unit_ = std::max(unit_, spectrum.unit());
    for (const auto& spectrum : spectra) {
      const Scalar scale = spectrum.unit() / unit_;
      std::vector<Scalar> ramp_products;
      for (std::size_t i = 0; i < spectrum.bins().size(); ++i) {
        const auto& bin = spectrum.bins()[i];
        if (bin.frequency > highest) break;
        if (i == bins_.size()) {
          bins_.push_back({bin.frequency, 0, 0, 0, Eigen::Map<const Vector>(bin.basis.data())});
        }
        bins_[i].count += bin.count;
        bins_[i].power += bin.power * scale * scale;
        ramp_products.push_back(bin.ramp_product * scale);
        if (&spectrum == spectra.data()) bins_[i].ramp_square = bin.ramp_square;
      }
      ramp_products_.push_back(std::move(ramp_products));
    }
  }

  [[nodiscard]] Scalar unit() const { return unit_; }
  /// The least S_k, in unit()²: the rounding of the largest sample. Without it, a signal that a ramp describes to the
  /// last digit would have no likelihood.
  [[nodiscard]] static Scalar floor() {
    return std::numeric_limits<Scalar>::epsilon() * std::numeric_limits<Scalar>::epsilon();
  }
  [[nodiscard]] std::size_t spectra() const { return ramp_products_.size(); }
  [[nodiscard]] std::size_t bins() const { return bins_.size(); }

  struct Fixed {
    NoiseTerm term;
    Scalar theta;
  };
  /// The most likely coefficients of a model near `start`, by default a smoothed spectrum; `fixed` holds one of them at
  /// a value. With several terms the likelihood can have more than one maximum, mostly far from the truth.
  [[nodiscard]] Result maximise(NoiseTerms terms, const std::optional<Fixed>& fixed = {},
                                const Vector* start = nullptr) const {
    constexpr int most_steps = 60;
    std::vector<Scalar> expected(bins_.size());
    if (start != nullptr) {
      expect(*start, expected);
    } else {
      smooth(expected);
    }
    Result best;
    best.slopes.assign(ramp_products_.size(), Scalar(0));
    if (terms.has(NoiseTerm::rate_ramp)) fit_slopes(expected, best);
    best.theta = start != nullptr ? *start : step(terms, fixed, expected, best.slopes);
    best.objective = evaluate(terms, best, expected);
    for (int i = 0; i < most_steps; ++i) {
      const Vector next = step(terms, fixed, expected, best.slopes);
      // Towards it as far as that is best: a full step may pass over the top and, of a model that does not describe the
      // signal, end as far from it on the other side.
      Scalar gain = 0;
      Result further = best;
      for (Scalar share = 1; share > Scalar(1e-3); share /= 2) {
        Result trial = best;
        trial.theta = best.theta + share * (next - best.theta);
        trial.objective = evaluate(terms, trial, expected);
        if (best.objective - trial.objective > gain) {
          gain = best.objective - trial.objective;
          further = std::move(trial);
        } else if (gain > 0) {
          break;
        }
      }
      best = std::move(further);
      expect(best.theta, expected);
      if (gain < Scalar(1e-9)) break;
    }
    return best;
  }

  /// How the observed power compares with the expected one from one frequency to another: ratio and its standard error.
  struct BandFit {
    Scalar lowest, highest;  ///< Hz
    Scalar ratio;
    Scalar standard_error;
    Scalar white_share;  ///< of the expected power
  };
  /// Octave by octave from the highest frequency down.
  [[nodiscard]] std::vector<BandFit> bands(const Result& result) const {
    std::vector<BandFit> bands;
    Scalar ratios = 0, count = 0, white = 0;
    std::size_t end = bins_.size();
    for (std::size_t i = bins_.size(); i-- > 0;) {
      const Bin& bin = bins_[i];
      const Scalar expected = std::max(bin.basis.dot(result.theta), floor());
      ratios += residual_power(i, result.slopes) / expected;
      white += bin.count * bin.basis[0] * result.theta[0] / expected;
      count += bin.count;
      if (i == 0 || bins_[i - 1].frequency <= bins_[end - 1].frequency / 2) {
        bands.push_back({bin.frequency, bins_[end - 1].frequency, ratios / count, std::sqrt(2 / count), white / count});
        end = i;
        ratios = count = white = 0;
      }
    }
    return bands;
  }

 private:
  struct Bin {
    Scalar frequency, count, power, ramp_square;
    Vector basis;
  };

  [[nodiscard]] Scalar residual_power(std::size_t i, const std::vector<Scalar>& slopes) const {
    Scalar power = bins_[i].power;
    for (std::size_t a = 0; a < slopes.size(); ++a) {
      power += slopes[a] * (slopes[a] * bins_[i].ramp_square - 2 * ramp_products_[a][i]);
    }
    return std::max(power, Scalar(0));
  }

  void expect(const Vector& theta, std::vector<Scalar>& expected) const {
    for (std::size_t i = 0; i < bins_.size(); ++i) expected[i] = std::max(bins_[i].basis.dot(theta), floor());
  }

  /// A first guess of S: means over a third of an octave about each bin.
  void smooth(std::vector<Scalar>& expected) const {
    std::size_t begin = 0, end = 0;
    Scalar power = 0, count = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      while (end < bins_.size() && (end < i + 4 || bins_[end].frequency < bins_[i].frequency * Scalar(1.125))) {
        power += bins_[end].power;
        count += bins_[end].count;
        ++end;
      }
      while (begin + 4 < i && bins_[begin].frequency * Scalar(1.125) < bins_[i].frequency) {
        power -= bins_[begin].power;
        count -= bins_[begin].count;
        ++begin;
      }
      expected[i] = std::max(power / count, floor());
    }
  }

  /// Least squares for the slopes of the ramps: the same standard error for all, since they share S.
  void fit_slopes(const std::vector<Scalar>& expected, Result& result) const {
    Scalar information = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) information += bins_[i].ramp_square / expected[i];
    for (std::size_t a = 0; a < ramp_products_.size(); ++a) {
      Scalar product = 0;
      for (std::size_t i = 0; i < bins_.size(); ++i) product += ramp_products_[a][i] / expected[i];
      result.slopes[a] = product / information;
    }
    result.slope_error = 1 / std::sqrt(information);
  }

  /// The objective at trial.theta with the best slopes for it, which it sets, as it does `expected`.
  [[nodiscard]] Scalar evaluate(NoiseTerms terms, Result& trial, std::vector<Scalar>& expected) const {
    expect(trial.theta, expected);
    if (terms.has(NoiseTerm::rate_ramp)) fit_slopes(expected, trial);
    Scalar sum = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      sum += bins_[i].count * std::log(expected[i]) + residual_power(i, trial.slopes) / expected[i];
    }
    return sum;
  }

  /// Weighted least squares of the power for θ ≥ 0, with the variance 2S² of the model.
  [[nodiscard]] Vector step(NoiseTerms terms, const std::optional<Fixed>& fixed, const std::vector<Scalar>& expected,
                            const std::vector<Scalar>& slopes) const {
    Matrix information = Matrix::Zero();
    Vector product = Vector::Zero();
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      const Scalar weight = 1 / (expected[i] * expected[i]);
      const Vector& basis = bins_[i].basis;
      information.noalias() += (bins_[i].count * weight) * basis * basis.transpose();
      product += (residual_power(i, slopes) * weight) * basis;
    }
    Vector held = Vector::Zero();
    unsigned candidates = 0;
    for (int j = 0; j < powers; ++j) {
      const auto term = static_cast<NoiseTerm>(j);
      if (fixed && fixed->term == term) {
        held[j] = fixed->theta;
      } else if (terms.has(term)) {
        candidates |= 1u << j;
      }
    }
    return held + non_negative_solution<Scalar, powers>(information, product - information * held, candidates);
  }

  Scalar unit_;
  std::vector<Bin> bins_;
  std::vector<std::vector<Scalar>> ramp_products_;  // of each spectrum, by bin
};

}  // namespace splinertia::allan
