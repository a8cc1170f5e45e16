// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <splinertia/allan/detail/chi_square_deviation.hpp>
#include <splinertia/allan/detail/fit_bands.hpp>
#include <splinertia/allan/detail/model/model_likelihood.hpp>
#include <splinertia/allan/interval.hpp>
#include <splinertia/detail/pi.hpp>
#include <utility>
#include <vector>

namespace splinertia::allan::detail {

/// Selects the bins of a spectrum that are used. Bins are left out if the user excluded them or if lines, resonances
/// and filters give them a power that noise terms do not have.
template <typename Scalar>
class BandSelection {
 public:
  using Fit = SpectralFit<Scalar>;
  using Spectrum = typename Fit::Spectrum;
  using Window = typename FitBands<Scalar>::Window;

  /// A ratio of powers that is off by less than this is no misfit.
  static constexpr Scalar tolerance = Scalar(5) / 1000;
  /// A misfit in standard deviations: chance exceeds it in at most one log of a thousand, with some 5000 windows each.
  static constexpr Scalar most_off = Scalar(21) / 4;

  BandSelection(std::reference_wrapper<const Spectrum> spectrum, Scalar highest,
                const std::vector<Interval<Scalar>>& excluded)
      : spectrum_(spectrum), included_(spectrum_.bins().size(), true), misfits_(spectrum_.bins().size(), false) {
    for (std::size_t i = 0; i < included_.size(); ++i) {
      const Scalar frequency = spectrum_.bins()[i].frequency;
      if (frequency > highest) included_[i] = false;
      for (const auto& band : excluded) {
        if (band.lower <= frequency && frequency <= band.upper) included_[i] = false;
      }
    }
    allowed_ = included_;
  }

  [[nodiscard]] const std::vector<bool>& included() const { return included_; }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::count(included_.begin(), included_.end(), true));
  }

  /// Repeatedly fits a model and leaves out the window that deviates most, until none is a misfit. The fit limits the
  /// count of each bin, so that the top octave, which has half of all b_k, does not outweigh all others. Lines are left
  /// out first: in a likelihood, a bin with ten thousand times the power outweighs all others.
  void leave_out_misfits(NoiseTerms terms) {
    leave_out_lines();
    const Scalar most_count = 32 * static_cast<Scalar>(spectrum_.spectra());
    const bool trend = terms.has(NoiseTerm::rate_ramp);
    typename Fit::Result last;
    for (std::size_t i = 0; i < included_.size(); ++i) {
      const Fit fit(spectrum_, included_, most_count);
      if (fit.groups() < 2 * static_cast<std::size_t>(Fit::powers)) return;
      const ModelLikelihood<Scalar> likelihood(fit);
      last = last.slopes.empty() ? likelihood.maximise(terms) : likelihood.maximum_near(terms, last);
      const Window window = FitBands<Scalar>(fit, last, trend, 6 * tolerance).worst(included_);
      if (std::abs(window.off) < most_off) break;
      mark(window.begin, window.end);
    }
    widen();
  }

  /// Leaves out a window and the margins that widen() adds.
  void leave_out(const Window& window) {
    mark(window.begin, window.end);
    widen();
  }

  /// Includes all bins again but those that the user excluded.
  void reset() {
    included_ = allowed_;
    misfits_.assign(misfits_.size(), false);
  }

  /// Runs [begin, end) of bins that are left out below the highest used one.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> gaps() const {
    std::vector<std::pair<std::size_t, std::size_t>> gaps;
    const std::size_t end = used_end();
    for (std::size_t i = 0; i < end; ++i) {
      if (included_[i]) continue;
      if (gaps.empty() || gaps.back().second != i) gaps.push_back({i, i});
      gaps.back().second = i + 1;
    }
    return gaps;
  }

  /// One past the highest used bin.
  [[nodiscard]] std::size_t used_end() const {
    std::size_t end = included_.size();
    while (end > 0 && !included_[end - 1]) --end;
    return end;
  }

 private:
  /// Leaves out bins with more than twice the median power of the bins within a quarter of their frequency, if they are
  /// above it by more than eight standard deviations.
  void leave_out_lines() {
    constexpr std::size_t fewest = 5;
    constexpr int most_deviations = 8;
    const auto& bins = spectrum_.bins();
    std::vector<Scalar> power;
    for (const auto& bin : bins) power.push_back(bin.power / (bin.count * bin.basis[0]));
    std::size_t begin = 0, end = 0;
    for (std::size_t i = 0; i < power.size(); ++i) {
      while (5 * bins[begin].frequency < 4 * bins[i].frequency) ++begin;
      while (end < bins.size() && 4 * bins[end].frequency <= 5 * bins[i].frequency) ++end;
      if (end - begin < fewest) continue;
      std::vector<Scalar> nearby(power.begin() + static_cast<std::ptrdiff_t>(begin),
                                 power.begin() + static_cast<std::ptrdiff_t>(end));
      const auto middle = nearby.begin() + static_cast<std::ptrdiff_t>(nearby.size() / 2);
      std::nth_element(nearby.begin(), middle, nearby.end());
      // The median of a mean of squares is below its expectation by this factor, to first order in 1/count.
      const Scalar ratio = power[i] / *middle * (1 - 2 / (3 * bins[i].count));
      if (ratio > 2 && chi_square_deviation(ratio, bins[i].count) > most_deviations) mark(i, i + 1);
    }
  }

  /// The number of bins above [begin, end) that its power leaks into, as explained at widen().
  [[nodiscard]] std::size_t skirt(std::size_t begin, std::size_t end) const {
    const auto& bins = spectrum_.bins();
    const auto density = [&](std::size_t i) { return bins[i].power / (bins[i].count * bins[i].basis[0]); };
    const std::size_t before = begin > 0 ? begin - 1 : begin, behind = (std::min)(end, bins.size() - 1);
    const Scalar level = (std::max)((std::min)(density(before), density(behind)), Fit::floor());
    Scalar excess = 0;
    for (std::size_t i = begin; i < end; ++i) excess += bins[i].count * (density(i) / level - 1);
    if (!(excess > 0)) return 0;
    const Scalar step = spectrum_.rate() / (2 * static_cast<Scalar>(spectrum_.samples()));
    const Scalar width = (std::min)(
        std::sqrt(50 * excess / static_cast<Scalar>(spectrum_.spectra())) / splinertia::detail::pi_of<Scalar>() * step,
        bins[begin].frequency / 2);
    std::size_t last = end;
    while (last < bins.size() && bins[last].frequency < bins[end - 1].frequency + width) ++last;
    return last - end;
  }

  void mark(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      included_[i] = false;
      misfits_[i] = true;
    }
  }

  /// Leaves out margins around misfits, where the same cause changes the power by too little to be found: a quarter of
  /// the band's width on either side, an octave at the upper end of the spectrum. Islands between two misfits are left
  /// out too. The finite log makes a line of E times the power of a b_k leak as E/(π·distance)², distance counted in
  /// b_k. The margin reaches to where this is a fiftieth, but at most to half the line's frequency.
  void widen() {
    constexpr std::size_t island = 6, octave = 45;
    std::vector<std::pair<std::size_t, std::size_t>> runs;
    for (std::size_t i = 0; i < included_.size(); ++i) {
      if (!misfits_[i] || !allowed_[i]) continue;
      if (runs.empty() || runs.back().second + island < i) runs.push_back({i, i});
      runs.back().second = i + 1;
    }
    for (const auto& [begin, end] : runs) {
      const std::size_t margin = (std::max)({std::size_t{1}, (end - begin) / 4, skirt(begin, end)});
      const bool top = end + island >= included_.size();
      const std::size_t below = top ? (std::max)(margin, octave) : margin;
      const std::size_t last = top ? included_.size() : (std::min)(end + margin, included_.size());
      for (std::size_t i = begin > below ? begin - below : 0; i < last; ++i) included_[i] = false;
    }
  }

  const Spectrum& spectrum_;
  std::vector<bool> included_, misfits_, allowed_;
};

}  // namespace splinertia::allan::detail
