// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/detail/require.hpp>
#include <vector>

namespace splinertia::allan {

/// Whether a sensor was left undisturbed, judged from its own log.
struct Stillness {
  std::int64_t blocks;     ///< number of blocks compared
  std::int64_t disturbed;  ///< blocks whose spread or largest deviation noise does not explain
  std::int64_t worst;      ///< first sample of the block furthest above its limit
  double worst_ratio;      ///< its standard deviation or largest deviation over the median of the blocks
};

}  // namespace splinertia::allan

namespace splinertia::detail {

/// Sums over half a block, of the samples less `origin`, so that a large mean costs no digits of the squares.
struct HalfBlock {
  double origin = 0, sum = 0, squares = 0, least = 0, greatest = 0;

  void add(double value, bool first) {
    if (first) origin = value;
    const double difference = value - origin;
    sum += difference;
    squares += difference * difference;
    least = (std::min)(least, difference);
    greatest = (std::max)(greatest, difference);
  }
};

/// The usual size of a quantity in blocks, and the limit above which a block is disturbed. Half the blocks set both: in
/// the logarithm, a quartile is 0.67 standard deviations from the median, and the limit is eight above it, twelve times
/// as far. The limit is at least `least` times the usual size, because few blocks say little, and at most eight times.
struct BlockLimit {
  BlockLimit(std::vector<double> values, double least) {
    const auto quartile = [&](std::size_t quarters) {
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(quarters * values.size() / 4);
      std::nth_element(values.begin(), middle, values.end());
      return *middle;
    };
    const double low = quartile(1), high = quartile(3);
    usual = quartile(2);
    const double width = low > 0 ? (std::max)(high / usual, usual / low) : 2;
    limit = usual * std::clamp(std::pow(width, 12), least, 8.0);
  }
  double usual, limit;
};

/// Appends the standard deviation and the largest distance from the mean of a block, which is made of two halves of
/// `count` samples each.
inline void add_block(const HalfBlock& last, const HalfBlock& next, double count, std::vector<double>& spreads,
                      std::vector<double>& peaks) {
  const double shift = next.origin - last.origin;
  const double mean = (last.sum + next.sum + count * shift) / (2 * count);
  const double squares = last.squares + next.squares + 2 * shift * next.sum + count * shift * shift;
  spreads.push_back(std::sqrt((std::max)(0.0, squares / (2 * count) - mean * mean)));
  peaks.push_back((std::max)((std::max)(last.greatest, next.greatest + shift) - mean,
                             mean - (std::min)(last.least, next.least + shift)));
}

}  // namespace splinertia::detail

namespace splinertia::allan {

/// Cuts a signal into blocks of `length` samples (about a second, at least 20) that overlap by half, and compares each
/// with the others: the standard deviation, and the largest deviation from the block's mean. The limits follow from how
/// much the blocks usually differ. A quarter of the blocks may be disturbed.
///
/// Found at any position in white noise of deviation σ (blocks of 100 samples, 1200 s at 100 Hz, 40 logs each):
///   one sample off by 12 σ or more (10 σ: 85 %, 8 σ: 20 %), with blocks of 1000 samples likewise by 12 σ;
///   0.1 s off by 8 σ (5 σ: 45 %); half a second off by 4 σ (3 σ: 50 to 70 %);
///   a step of 5 σ; noise that is twice as strong for a second.
///
/// Not found: weaker disturbances than these, motion that lasts all the time, and drift slower than a block. Nothing is
/// found if most blocks are constant, because what is usual is then unknown.
///
/// False alarms: none in 40 logs each (1 h at 100 Hz) of white noise, random walks, flicker noise, Gauss–Markov noise,
/// lines, resonances, rounding to 0.3 to 6 σ, angle quantization, a low-pass, sample-and-hold; nor in a random walk
/// alone. Throws std::invalid_argument for a length below 20.
template <Signal S>
[[nodiscard]] Stillness measure_stillness(const S& signal, std::int64_t length) {
  splinertia::detail::require(length >= 20, "measure_stillness", "length", length, "at least 20 samples");
  const std::int64_t half = length / 2;
  std::vector<double> spreads, peaks;
  splinertia::detail::HalfBlock last;
  double resolution = std::numeric_limits<double>::infinity();
  auto value = std::begin(signal), previous = value;
  const std::int64_t halves = std::distance(value, std::end(signal)) / half;
  for (std::int64_t i = 0; i < halves; ++i) {
    splinertia::detail::HalfBlock next;
    for (std::int64_t k = 0; k < half; ++k, previous = value++) {
      next.add(static_cast<double>(*value), k == 0);
      const double change = std::abs(static_cast<double>(*value) - static_cast<double>(*previous));
      if (change > 0) resolution = (std::min)(resolution, change);
    }
    if (i > 0) splinertia::detail::add_block(last, next, static_cast<double>(half), spreads, peaks);
    last = next;
  }
  Stillness result{static_cast<std::int64_t>(spreads.size()), 0, 0, 1};
  if (spreads.empty()) return result;
  const splinertia::detail::BlockLimit of_spreads(spreads, std::exp(7 / std::sqrt(4 * static_cast<double>(half))));
  splinertia::detail::BlockLimit of_peaks(peaks, 2.5);
  if (of_spreads.usual == 0) return result;
  of_peaks.limit = (std::max)(of_peaks.limit, of_peaks.usual + 2.5 * resolution);
  double worst = 0;
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    const double excess = (std::max)(spreads[i] / of_spreads.limit, peaks[i] / of_peaks.limit);
    if (excess > 1) ++result.disturbed;
    if (excess <= worst) continue;
    worst = excess;
    result.worst = static_cast<std::int64_t>(i) * half;
    result.worst_ratio = (std::max)(spreads[i] / of_spreads.usual, peaks[i] / of_peaks.usual);
  }
  return result;
}

}  // namespace splinertia::allan
