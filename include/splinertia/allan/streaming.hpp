// SPDX-License-Identifier: MIT
/// Streaming Allan analysis of logs of any length, sample by sample:
///
///   allan::StreamingAllanDeviation<double> allan(200.0);
///   while (read(y)) allan.push(y);
///   auto curve = allan.curve();
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/compensated_sum.hpp>
#include <splinertia/allan/detail/degrees_of_freedom.hpp>
#include <splinertia/allan/deviations.hpp>
#include <splinertia/allan/noise_type.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace splinertia::allan {

/// noise_type() of averages over m samples that arrive one by one.
template <typename Scalar>
class StreamingNoiseType {
 public:
  /// Adds the next average, or the next sum: both have the same power law.
  void add(Scalar z) {
    if (count() == detail::most_averages) return;
    const Scalar difference = z - last_, second = difference - last_difference_;
    if (count() > 1) lags_[2].add(second);
    if (count() > 0) lags_[1].add(difference);
    lags_[0].add(z);
    last_ = z;
    last_difference_ = difference;
  }

  [[nodiscard]] std::int64_t count() const { return lags_[0].count; }

  [[nodiscard]] int alpha() const {
    for (int d = 0;; ++d) {
      const Lags& lags = lags_[static_cast<std::size_t>(d)];
      if (const auto alpha = detail::power_law(lags.lag0(), lags.lag1(), static_cast<Scalar>(lags.count), d))
        return *alpha;
    }
  }

 private:
  /// Sums over a series less its first value. That is close enough to the mean for the mean to be subtracted at the
  /// end.
  struct Lags {
    std::int64_t count = 0;
    Scalar first{0}, last{0}, sum{0}, squares{0}, products{0};

    void add(Scalar w) {
      if (count++ == 0) first = w;
      w -= first;
      sum += w;
      squares += w * w;
      products += w * last;
      last = w;
    }
    [[nodiscard]] Scalar lag0() const { return squares - sum * (sum / static_cast<Scalar>(count)); }
    [[nodiscard]] Scalar lag1() const {
      const auto n = static_cast<Scalar>(count);
      const Scalar mean = sum / n;
      return products - mean * (2 * sum - last) + (n - 1) * (mean * mean);
    }
  };

  std::array<Lags, 3> lags_;  ///< of the averages, their first and their second differences
  Scalar last_{0}, last_difference_{0};
};

/// The overlapping Allan deviation for averaging factors 1, 2, 4 … The samples are not stored.
///
/// Up to m = 16 it averages the terms of OverlappingAllanDeviation, one per sample, and has the same values. Above, it
/// averages one term per m/16 samples. That costs 0.5 % of the degrees of freedom for white noise and none for flicker
/// noise and random walk. Quantisation noise, whose differences are independent from sample to sample, keeps a share of
/// 16/m; but averages over more than 16 samples contain so little of it that other noise dominates.
///
/// The offset is subtracted from each sample, and every sum is the sum of two sums of half as many samples, so that
/// only neighbouring sums are subtracted from each other. The relative error of the deviations is below 1e-12 for an
/// offset within ten standard deviations of the mean. Memory: 500 bytes per octave of m. Time: 16 to 25 ns a sample on
/// one core of a Xeon.
template <std::floating_point Scalar_ = double>
  requires(std::numeric_limits<Scalar_>::digits >= std::numeric_limits<double>::digits)
class StreamingAllanDeviation {
 public:
  using Scalar = Scalar_;

  /// Requires rate [Hz] > 0, an offset near the mean in the samples' unit (default: the first sample) and the largest
  /// averaging factor to compute, >= 1. Throws std::invalid_argument for other values.
  explicit StreamingAllanDeviation(Scalar rate, std::optional<Scalar> offset = {},
                                   std::int64_t largest_factor = (std::numeric_limits<std::int64_t>::max)())
      : rate_(rate), largest_factor_(largest_factor), offset_(offset) {
    splinertia::detail::require_positive("StreamingAllanDeviation", "rate", rate);
    if (offset) splinertia::detail::require_finite("StreamingAllanDeviation", "offset", *offset);
    splinertia::detail::require(largest_factor >= 1, "StreamingAllanDeviation", "largest_factor", largest_factor,
                                "an integer >= 1");
  }

  /// Adds the next sample. Throws std::invalid_argument, and changes nothing, if it is not finite or so far from the
  /// offset that squares of sums could overflow (5e129 for double).
  template <typename Sample>
    requires std::is_arithmetic_v<Sample>
  void push(Sample sample) {
    const Scalar value = static_cast<Scalar>(sample) - offset_.value_or(static_cast<Scalar>(sample));
    if (!(std::abs(value) <= largest_value)) refuse_sample(sample);
    if (samples_ == 0) {
      offset_ = offset_.value_or(static_cast<Scalar>(sample));
      first_ = value;
    }
    constant_ = constant_ && value == first_;
    sum_.add(value);
    ++samples_;
    Scalar block = slide<1>(0, value);
    for (std::size_t level = 1; (samples_ >> (level - 1)) % 2 == 0; ++level) {
      if (level == levels_.size() && !add_level()) return;
      block = slide<window>(level, block);
    }
  }

  [[nodiscard]] std::int64_t samples() const { return samples_; }

  /// The curve of the samples so far; for the parameters see CurveOptions. Omits factors that have no term yet. Throws
  /// std::invalid_argument for fewer than 3 samples, a constant signal, and parameters out of range.
  [[nodiscard]] DeviationCurve<Scalar> curve(Scalar confidence = detail::one_sigma<Scalar>,
                                             std::optional<int> alpha = {},
                                             PhaseModel phase_model = PhaseModel::greenhall_riley) const {
    using Deviation = OverlappingAllanDeviation;
    if (samples_ < 3) {
      splinertia::detail::refuse<std::invalid_argument>("Allan analysis: ", samples_, " values, expected at least 3");
    }
    if (constant_) {
      splinertia::detail::refuse<std::invalid_argument>("Allan analysis: the signal is constant (", *offset_ + first_,
                                                        "): a sensor that is stuck, or no noise at all");
    }
    const Scalar mean = *offset_ + sum_.value() / static_cast<Scalar>(samples_);
    DeviationCurve<Scalar> result{std::string(Deviation::name), rate_, samples_, mean, confidence, {}};
    int identified = 0;
    for (std::size_t octave = 0; octave < octaves(); ++octave) {
      const std::int64_t m = std::int64_t{1} << octave, stride = std::max<std::int64_t>(1, m / window);
      const std::int64_t terms = detail::number_of_terms({}, m, samples_ + 1, stride);
      if (terms < 1 || m > largest_factor_) break;
      const Octave& sums = octave < steps ? first_octaves_[octave] : levels_[octave - steps + 1].octave;
      const bool enough = sums.noise_type.count() >= detail::fewest_averages;
      identified = enough ? sums.noise_type.alpha() : (std::min)(identified, 0);
      const auto freedom = static_cast<Scalar>(detail::equivalent_degrees_of_freedom(
          {}, alpha.value_or((std::max)(identified, steepest_power_law<Deviation>)), m, terms, stride, phase_model));
      const auto factor = static_cast<Scalar>(m);
      const Scalar deviation = std::sqrt(sums.squares.value() / static_cast<Scalar>(2 * terms)) / factor;
      result.points.push_back({m, factor / rate_, terms, deviation, alpha.value_or(identified), freedom,
                               detail::deviation_interval(deviation, freedom, confidence)});
    }
    return result;
  }

 private:
  static constexpr std::int64_t window = 16;  ///< blocks in a sum over m samples, from m = 16 on
  static constexpr std::size_t steps = 5;     ///< number of block counts 1, 2, 4, 8, 16 (window)

  struct Octave {
    detail::CompensatedSum<Scalar> squares;
    StreamingNoiseType<Scalar> noise_type;
  };

  /// Blocks of 2^level samples. The sum of the newest w blocks, w = 1, 2, 4, 8, 16, is the sum of the newest w/2 plus
  /// that of the w/2 blocks before. past[w + i % w] is the sum of w blocks at block i, until block i + w overwrites it.
  struct Level {
    std::array<Scalar, 2 * window> past{};
    Octave octave;  ///< of m = window blocks, for level 1 and above
  };

  /// Processes the next block of a level: adds the terms of sums over `shortest` or more blocks. Returns the sum of the
  /// last two blocks.
  template <std::uint64_t shortest>
  Scalar slide(std::size_t level, const Scalar& block) {
    const std::uint64_t blocks = static_cast<std::uint64_t>(samples_) >> level;
    Scalar* const past = levels_[level].past.data();
    Octave* octave = shortest == 1 ? first_octaves_.data() : &levels_[level].octave;
    Scalar sum = block, pair = block;
    for (std::uint64_t w = 1; w <= window; w *= 2) {
      Scalar& slot = past[w + ((blocks - 1) & (w - 1))];
      const Scalar before = slot;
      slot = sum;
      if (w >= shortest) {
        const Scalar difference = sum - before;
        if (blocks >= 2 * w) octave->squares.add(difference * difference);
        if ((blocks & (w - 1)) == 0) octave->noise_type.add(sum);
        ++octave;
      }
      sum += before;
      if (w == 1) pair = sum;
    }
    return pair;
  }

  /// Returns false if its averaging factor is above the largest one requested.
  bool add_level() {
    if (window > largest_factor_ >> levels_.size()) return false;
    levels_.emplace_back();
    return true;
  }

  [[nodiscard]] std::size_t octaves() const { return steps + levels_.size() - 1; }

  template <typename Sample>
  [[noreturn]] void refuse_sample(const Sample& sample) const {
    splinertia::detail::refuse<std::invalid_argument>("Allan analysis: value ", samples_, " is ", sample,
                                                      ", expected a number within ", largest_value, " of the offset");
  }

  /// 2⁴³¹ for double: n squares of 2 m times this value are representable for m and n up to 2⁵³.
  static constexpr Scalar largest_value = [] {
    Scalar result = 1;
    for (int i = 0; i < (std::numeric_limits<Scalar>::max_exponent - 162) / 2; ++i) result *= 2;
    return result;
  }();

  Scalar rate_;
  std::int64_t largest_factor_;
  std::optional<Scalar> offset_;
  std::int64_t samples_ = 0;
  Scalar first_{0};
  bool constant_ = true;
  detail::CompensatedSum<Scalar> sum_;
  std::array<Octave, steps> first_octaves_;
  std::vector<Level> levels_ = std::vector<Level>(1);
};

}  // namespace splinertia::allan
