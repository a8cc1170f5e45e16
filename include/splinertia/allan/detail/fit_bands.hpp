// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/chi_square_deviation.hpp>
#include <splinertia/allan/detail/model/spectral_fit.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <vector>

namespace splinertia::allan::detail {

/// Compares the power of a log with that of a fitted model, band by band.
template <typename Scalar>
class FitBands {
 public:
  using Fit = SpectralFit<Scalar>;

  /// For the result of a fit. A ratio that is off by less than `tolerance` is no misfit.
  FitBands(const Fit& fit, const typename Fit::Result& result, bool trend, Scalar tolerance)
      : bins_(fit.spectrum().bins()),
        all_(fit.compare(result, trend)),
        rate_(fit.spectrum().rate()),
        unit_(fit.spectrum().unit()),
        tolerance_(tolerance) {}

  struct Window {
    std::size_t begin, end;  ///< bins
    Scalar off;              ///< deviation of the ratio from 1 in standard deviations; negative: too little power
  };

  /// The most significant misfit among the included bins: of one bin, or of up to an octave of neighbours.
  [[nodiscard]] Window worst(const std::vector<bool>& included) const {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      if (included[i]) used.push_back(i);
    }
    std::vector<Scalar> ratios(used.size() + 1), counts(used.size() + 1);
    for (std::size_t j = 0; j < used.size(); ++j) {
      ratios[j + 1] = ratios[j] + all_[used[j]].residual / all_[used[j]].expected;
      counts[j + 1] = counts[j] + bins_[used[j]].count;
    }
    Window worst{0, 0, 0};
    for (const std::size_t length : {1U, 2U, 3U, 4U, 6U, 8U, 12U, 16U, 24U, 32U, 48U}) {
      const std::size_t stride = std::max<std::size_t>(1, length / 4);
      for (std::size_t j = 0; j + length <= used.size(); j += stride) {
        const Scalar off = deviation(ratios[j + length] - ratios[j], counts[j + length] - counts[j]);
        if (std::abs(off) > std::abs(worst.off)) worst = {used[j], used[j + length - 1] + 1, off};
      }
    }
    return worst;
  }

  /// Octaves of included bins, highest frequency first.
  struct Octave {
    BandFit<Scalar> fit;
    Scalar count;
  };
  [[nodiscard]] std::vector<Octave> octaves(const std::vector<bool>& included) const {
    std::vector<Octave> octaves;
    Scalar ratios = 0, count = 0, lowest = 0, highest = 0;
    const auto close = [&] {
      if (count > 0) octaves.push_back({{{lowest, highest}, ratios / count, std::sqrt(2 / count)}, count});
      ratios = count = 0;
    };
    Scalar top = bins_.back().frequency;
    for (std::size_t i = bins_.size(); i-- > 0;) {
      if (bins_[i].frequency <= top / 2) {
        close();
        top = bins_[i].frequency;
      }
      if (!included[i]) continue;
      if (count == 0) highest = bins_[i].frequency;
      lowest = bins_[i].frequency;
      ratios += all_[i].residual / all_[i].expected;
      count += bins_[i].count;
    }
    close();
    return octaves;
  }

  /// All bins in about eight points per octave. The bins of a point are either all used or all left out.
  [[nodiscard]] std::vector<SpectrumPoint<Scalar>> spectrum(const std::vector<bool>& included) const {
    std::vector<SpectrumPoint<Scalar>> points;
    const Scalar scale = unit_ / std::sqrt(rate_);
    for (std::size_t begin = 0, end = 0; begin < bins_.size(); begin = end) {
      while (end < bins_.size() && included[end] == included[begin] &&
             12 * bins_[end].frequency <= 13 * bins_[begin].frequency) {
        ++end;
      }
      const Sums sums = sums_of(begin, end);
      points.push_back({(bins_[begin].frequency + bins_[end - 1].frequency) / 2,
                        std::sqrt(sums.power / sums.count) * scale, std::sqrt(sums.expected / sums.count) * scale,
                        sums.count, included[begin]});
    }
    return points;
  }

  /// The bins [begin, end) as one band.
  [[nodiscard]] BandFit<Scalar> band(std::size_t begin, std::size_t end) const {
    const Sums sums = sums_of(begin, end);
    return {{bins_[begin].frequency, bins_[end - 1].frequency}, sums.power / sums.expected, std::sqrt(2 / sums.count)};
  }

  /// p-value of the deviations of the octaves, in both directions, from a model that was fitted with this many
  /// parameters. The sum of their squares is nearly chi-square.
  [[nodiscard]] static Scalar probability(const std::vector<Octave>& octaves, Scalar parameters, Scalar tolerance) {
    Scalar sum = 0;
    for (const Octave& octave : octaves) {
      const Scalar off = deviation(octave.fit.ratio * octave.count, octave.count, tolerance);
      sum += off * off;
    }
    const Scalar freedom = (std::max)(static_cast<Scalar>(octaves.size()) - parameters, Scalar(1));
    return chi_square_upper_tail(sum, freedom);
  }

 private:
  /// Sums over bins of the power of the signal itself: the power of its differences over that of unit white noise,
  /// basis[0].
  struct Sums {
    Scalar power = 0, expected = 0, count = 0;
  };
  [[nodiscard]] Sums sums_of(std::size_t begin, std::size_t end) const {
    Sums sums;
    for (std::size_t i = begin; i < end; ++i) {
      sums.power += all_[i].residual / bins_[i].basis[0];
      sums.expected += all_[i].expected * bins_[i].count / bins_[i].basis[0];
      sums.count += bins_[i].count;
    }
    return sums;
  }

  /// Zero within the tolerance, otherwise the deviation of what is beyond it.
  [[nodiscard]] static Scalar deviation(Scalar sum, Scalar count, Scalar tolerance) {
    const Scalar ratio = sum / count;
    if (std::abs(ratio - 1) <= tolerance) return 0;
    return chi_square_deviation(ratio > 1 ? ratio - tolerance : ratio + tolerance, count);
  }
  [[nodiscard]] Scalar deviation(Scalar sum, Scalar count) const { return deviation(sum, count, tolerance_); }

  const std::vector<typename Fit::Spectrum::Bin>& bins_;
  std::vector<typename Fit::Comparison> all_;
  Scalar rate_, unit_;
  Scalar tolerance_;
};

}  // namespace splinertia::allan::detail
