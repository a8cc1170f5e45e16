// SPDX-License-Identifier: MIT
/// Recognises stamps that are arrival times of packets, not times of samples.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace splinertia::allan {

/// Samples that come in packets: some in quick succession, then a pause until the next packet.
struct Bursts {
  double samples;        ///< in a burst, mean
  double spacing;        ///< between the samples of a burst, median, s
  double period;         ///< from one burst to the next, mean, s
  double rate;           ///< Hz: samples over time, from the start of the first whole burst to that of the last
  std::int64_t holes;    ///< pauses longer than three usual ones; not counted in the rate
  std::int64_t missing;  ///< number of samples missing in the holes
};

}  // namespace splinertia::allan

namespace splinertia::detail {

/// The upper median. Requires values, and changes their order.
[[nodiscard]] inline double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The sums of each `row` intervals in succession, in order. Requires 1 ≤ row ≤ intervals.
[[nodiscard]] inline std::vector<double> sums_of_rows(std::span<const double> intervals, std::size_t row) {
  std::vector<double> sums;
  sums.reserve(intervals.size() - row + 1);
  double sum = 0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    sum += intervals[i];
    if (i + 1 < row) continue;
    sums.push_back(sum);
    sum -= intervals[i + 1 - row];
  }
  return sums;
}

/// The mean of `row` intervals in succession, median over all such rows: holes and bursts hardly change it.
[[nodiscard]] inline double typical_mean(std::span<const double> intervals, std::size_t row) {
  row = (std::min)(row, intervals.size());
  std::vector<double> sums = sums_of_rows(intervals, row);
  return median_of(sums) / static_cast<double>(row);
}

}  // namespace splinertia::detail

namespace splinertia::allan {

/// Recognises bursts of 2 to about 100 samples in the intervals of stamps (s). Nine tenths of the intervals are either
/// shorter than a quarter of their mean or longer than it, and pauses recur at least every 128 samples. Returns nothing
/// for stamps that merely jitter, and for fewer than 16 intervals.
[[nodiscard]] inline std::optional<Bursts> find_bursts(std::span<const double> intervals) {
  constexpr std::size_t longest_burst = 128;
  const std::size_t n = intervals.size();
  if (n < 16) return std::nullopt;
  const double mean = splinertia::detail::typical_mean(intervals, longest_burst);
  std::vector<double> shorts, pauses;
  for (const double interval : intervals) {
    if (interval < mean / 4) shorts.push_back(interval);
    if (interval > mean) pauses.push_back(interval);
  }
  if (10 * (shorts.size() + pauses.size()) < 9 * n || 3 * shorts.size() < n || longest_burst * pauses.size() < n ||
      pauses.size() < 3) {
    return std::nullopt;
  }
  const double spacing = splinertia::detail::median_of(shorts), pause = splinertia::detail::median_of(pauses);

  Bursts bursts{0, spacing, 0, 0, 0, 0};
  const auto is_pause = [mean](double interval) { return interval > mean; };
  const auto first = std::find_if(intervals.begin(), intervals.end(), is_pause) + 1;
  const auto last = std::find_if(intervals.rbegin(), intervals.rend(), is_pause).base();
  double time = 0, in_holes = 0;
  std::int64_t samples = 0, pauses_without_holes = 0;
  for (auto interval = first; interval != last; ++interval) {
    if (*interval > 3 * pause) {
      ++bursts.holes;
      in_holes += *interval - pause;
      time += pause;
    } else {
      time += *interval;
    }
    ++samples;
    if (is_pause(*interval)) ++pauses_without_holes;
  }
  bursts.samples = static_cast<double>(samples) / static_cast<double>(pauses_without_holes);
  bursts.rate = static_cast<double>(samples) / time;
  bursts.period = bursts.samples / bursts.rate;
  bursts.missing = std::llround((std::min)(in_holes * bursts.rate, 1e15));  // fits in 64 bits
  return bursts;
}

}  // namespace splinertia::allan
