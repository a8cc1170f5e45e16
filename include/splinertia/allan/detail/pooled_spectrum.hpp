// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <splinertia/allan/difference_spectrum.hpp>
#include <vector>

namespace splinertia::allan::detail {

/// The spectrum of one signal's differences, or the pooled spectra of several signals with the same noise (three axes
/// that are alike), in one unit. Powers are added. Trends stay separate, because each axis drifts in its own direction.
template <typename Scalar>
class PooledSpectrum {
 public:
  static constexpr int powers = DifferenceSpectrum<Scalar>::powers;

  struct Bin {
    Scalar frequency;                           ///< Hz
    Scalar count, power;                        ///< number of b_k, and Σ b_k² in unit()²
    Eigen::Matrix<Scalar, powers, 1> basis;     ///< mean square of b_k if N²·rate, K²/rate, B² or Q²·rate² is 1
    Scalar ramp_square, odd_count, even_count;  ///< of a single spectrum
  };
  /// The sums over a bin of one spectrum that determine a trend.
  struct TrendSums {
    Scalar ramp_product, odd, even;
  };

  /// Requires spectra with the same rate and length.
  explicit PooledSpectrum(std::span<const DifferenceSpectrum<Scalar>> spectra)
      : rate_(spectra[0].rate()), unit_(0), samples_(spectra[0].samples()) {
    for (const auto& spectrum : spectra) unit_ = (std::max)(unit_, spectrum.unit());
    for (const auto& spectrum : spectra) {
      const Scalar scale = spectrum.unit() / unit_;
      std::vector<TrendSums> sums;
      for (std::size_t i = 0; i < spectrum.bins().size(); ++i) {
        const auto& bin = spectrum.bins()[i];
        if (i == bins_.size()) {
          bins_.push_back({bin.frequency, 0, 0, Eigen::Map<const Eigen::Matrix<Scalar, powers, 1>>(bin.basis.data()),
                           bin.ramp_square, bin.odd_count, bin.count - bin.odd_count});
        }
        bins_[i].count += bin.count;
        bins_[i].power += bin.power * scale * scale;
        sums.push_back({bin.ramp_product * scale, bin.odd_sum * scale, bin.even_sum * scale});
      }
      trend_sums_.push_back(std::move(sums));
    }
  }

  [[nodiscard]] const std::vector<Bin>& bins() const { return bins_; }
  /// Indexed by spectrum, then by bin.
  [[nodiscard]] const std::vector<std::vector<TrendSums>>& trend_sums() const { return trend_sums_; }
  [[nodiscard]] std::size_t spectra() const { return trend_sums_.size(); }
  [[nodiscard]] Scalar rate() const { return rate_; }  ///< Hz
  [[nodiscard]] Scalar unit() const { return unit_; }  ///< in the unit of the signal
  [[nodiscard]] std::int64_t samples() const { return samples_; }
  [[nodiscard]] Scalar duration() const { return static_cast<Scalar>(samples_) / rate_; }  ///< s

  /// The mean of b_k at a bin's frequency, for odd and even k, of a trend with the differences e^(−t/decay_time) (1 at
  /// the beginning): √(2/n)·sin θ·(1 ± r^n)/((1 − r)² + 4r sin²(θ/2)), plus for odd k, r = e^(−1/(rate·decay_time)),
  /// θ = πk/n.
  struct TrendMeans {
    Scalar odd, even;
  };
  [[nodiscard]] TrendMeans trend_means(const Bin& bin, Scalar decay_time) const {
    const Scalar step = 1 / (rate_ * decay_time), lost = -std::expm1(-step);
    const Scalar end = std::exp(-step * static_cast<Scalar>(samples_));
    const Scalar chord = std::sqrt(bin.basis[0]);
    const Scalar sine = chord * std::sqrt((std::max)(1 - bin.basis[0] / 4, Scalar(0)));
    const Scalar common =
        std::sqrt(2 / static_cast<Scalar>(samples_)) * sine / (lost * lost + (1 - lost) * bin.basis[0]);
    return {common * (1 + end), common * (1 - end)};
  }

 private:
  Scalar rate_, unit_;
  std::int64_t samples_;
  std::vector<Bin> bins_;
  std::vector<std::vector<TrendSums>> trend_sums_;
};

}  // namespace splinertia::allan::detail
