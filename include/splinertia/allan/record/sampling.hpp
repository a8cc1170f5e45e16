// SPDX-License-Identifier: MIT
/// How regularly a log was sampled. An Allan analysis assumes equal spacing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <ranges>
#include <span>
#include <splinertia/allan/record/bursts.hpp>
#include <splinertia/allan/record/missing_samples.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <vector>

namespace splinertia::allan {

namespace detail {

/// The interval from one sample to the next.
template <TimePoint Time>
struct StampInterval {
  std::int64_t index;  ///< of the sample that it begins with, from 0
  Time time;           ///< of that sample
  double duration;     ///< s
};

}  // namespace detail

template <TimePoint Time>
struct Sampling {
  std::int64_t samples;
  double rate;                          ///< Hz, of the sensor: missing samples count
  double nominal_interval;              ///< median of the intervals, s; for bursts 1/rate
  double jitter;                        ///< root mean square of interval − nominal interval, without gaps, s
  double largest_jitter;                ///< s
  detail::StampInterval<Time> longest;  ///< longest of all intervals, gaps included
  std::int64_t gaps;                    ///< number of places where samples are missing
  std::int64_t missing;                 ///< number of missing samples
  std::optional<Bursts> bursts;         ///< set if the stamps are arrival times of packets; gaps are then their holes

  /// Missing samples over all that there should be.
  [[nodiscard]] double missing_share() const {
    return static_cast<double>(missing) / static_cast<double>(samples + missing);
  }
};

}  // namespace splinertia::allan

namespace splinertia::detail {

/// The intervals of stamps in s, except those before the samples `breaks`, and the longest of them.
template <TimePoint Time>
struct StampIntervals {
  std::vector<double> durations;
  allan::detail::StampInterval<Time> longest{};
  double total = 0;  // s

  template <std::ranges::forward_range Stamps>
  StampIntervals(const Stamps& stamps, std::span<const std::int64_t> breaks) {
    std::optional<Time> first, last;
    std::int64_t index = 0;
    auto next_break = breaks.begin();
    Time left_out{};
    for (const Time& time : stamps) {
      check(index, time, first, last);
      const bool is_break = next_break != breaks.end() && *next_break == index;
      if (is_break) ++next_break;
      if (last) {
        if (is_break) {
          left_out += time - *last;
        } else {
          durations.push_back(to_seconds<double>(time - *last));
          if (durations.back() > longest.duration) longest = {index - 1, *last, durations.back()};
        }
      } else {
        first = time;
      }
      last = time;
      ++index;
    }
    if (durations.size() < 2) {
      refuse<std::invalid_argument>("sampling: ", index, " stamps, expected at least 3");
    }
    total = to_seconds<double>(*last - *first - left_out);
  }

 private:
  static void check(std::int64_t index, const Time& time, const std::optional<Time>& first,
                    const std::optional<Time>& last) {
    if constexpr (std::floating_point<Time>) {
      if (!is_finite(time)) {
        refuse<std::invalid_argument>("sampling: stamp ", index, " is ", time, ", expected a finite number");
      }
    } else if (first && *first < Time::zero() && time > (Time::max)() + *first) {
      refuse<std::invalid_argument>("sampling: stamp ", index, " is ", seconds_or_ticks(time), ", the first one ",
                                    seconds_or_ticks(*first), ", expected a difference that fits their type");
    }
    if (last && !(*last < time)) {
      refuse<std::invalid_argument>("sampling: stamp ", index, " is ", seconds_or_ticks(time), ", the one before it ",
                                    seconds_or_ticks(*last), ", expected increasing stamps");
    }
  }
};

/// The interval of the sampling grid, as if no sample were missing. If at least 95 % of the intervals are near a
/// multiple of their median, it is the mean of those near the median. Otherwise the stamps jitter or are coarse, so
/// that single intervals say little: it is then the mean of 8 in a row over all rows without a missing sample.
[[nodiscard]] inline double grid_interval(std::span<const double> intervals, double median) {
  constexpr std::size_t row = 8;
  std::size_t near_multiple = 0, nearby = 0;
  double off = 0;
  for (const double interval : intervals) {
    const double count = (std::max)(1.0, std::round(interval / median));
    if (std::abs(interval / median - count) > 0.15) continue;
    ++near_multiple;
    if (count > 1) continue;
    ++nearby;
    off += interval - median;
  }
  if (20 * near_multiple >= 19 * intervals.size()) return median + off / static_cast<double>(nearby);
  if (intervals.size() < 8 * row) return median;

  struct Rows {
    std::size_t count = 0;
    double mean = 0;
  };
  const std::vector<double> sums = sums_of_rows(intervals, row);
  const auto rows_near = [&](double nominal, double share) {  // whose sum is that of `row` intervals
    Rows rows;
    for (const double sum : sums) {
      if (std::abs(sum / nominal - row) > share) continue;
      ++rows.count;
      rows.mean += sum;
    }
    rows.mean = rows.count > 0 ? rows.mean / static_cast<double>(rows.count * row) : nominal;
    return rows;
  };
  const double of_rows = typical_mean(intervals, 2 * row);
  double nominal = rows_near(median, 0.25).count > rows_near(of_rows, 0.25).count ? median : of_rows;
  for (int i = 0; i < 3; ++i) nominal = rows_near(nominal, 0.5).mean;
  return nominal;
}

}  // namespace splinertia::detail

namespace splinertia::allan {

/// Measures the sampling from time stamps: seconds, or an integer std::chrono::duration. `breaks` are the indices, in
/// increasing order, of samples before which a stretch was left out on purpose; no sample is missing there. Throws
/// std::invalid_argument for fewer than 3 stamps, and for stamps that are not finite or do not increase, naming the
/// first of them. Memory: three doubles per stamp.
template <std::ranges::forward_range Stamps>
  requires TimePoint<std::ranges::range_value_t<Stamps>>
[[nodiscard]] Sampling<std::ranges::range_value_t<Stamps>> measure_sampling(const Stamps& stamps,
                                                                            std::span<const std::int64_t> breaks = {}) {
  using Time = std::ranges::range_value_t<Stamps>;
  const splinertia::detail::StampIntervals<Time> intervals(stamps, breaks);
  const std::vector<double>& durations = intervals.durations;
  const auto samples = static_cast<std::int64_t>(durations.size() + breaks.size()) + 1;
  Sampling<Time> result{samples, 0, 0, 0, 0, intervals.longest, 0, 0, find_bursts(durations)};
  std::vector<MissingSamples> places;
  if (result.bursts) {
    result.nominal_interval = 1 / result.bursts->rate;
    result.rate = result.bursts->rate;
    result.gaps = result.bursts->holes;
    result.missing = result.bursts->missing;
  } else {
    std::vector<double> sorted = durations;
    result.nominal_interval = splinertia::detail::median_of(sorted);
    places = find_missing_samples(durations, splinertia::detail::grid_interval(durations, result.nominal_interval));
    result.gaps = static_cast<std::int64_t>(places.size());
    for (const MissingSamples& place : places) result.missing += place.count;
    result.rate = static_cast<double>(static_cast<std::int64_t>(durations.size()) + result.missing) / intervals.total;
  }
  double squares = 0;
  std::size_t counted = 0;
  auto place = places.begin();
  for (std::size_t i = 0; i < durations.size(); ++i) {
    if (place != places.end() && place->interval == static_cast<std::int64_t>(i)) {
      ++place;
      continue;
    }
    const double off = std::abs(durations[i] - result.nominal_interval);
    squares += off * off;
    ++counted;
    result.largest_jitter = (std::max)(result.largest_jitter, off);
  }
  if (counted > 0) result.jitter = std::sqrt(squares / static_cast<double>(counted));
  return result;
}

/// How irregular a log may be to be analysed as if its samples were equally spaced.
struct SamplingLimits {
  /// Largest share of missing samples. The samples on both sides of a gap are taken as neighbours; nothing is filled
  /// in. This leaves white noise unchanged, because it has no order; interpolation would not. Averaging times and K²
  /// are off by the missing share. Effects that depend on order suffer: a random walk steps by a whole gap at once,
  /// quantization errors no longer cancel, and a long gap often means that the sensor was restarted with another bias.
  /// With one sample in a thousand missing, all that is below the uncertainty of what an hour at rest says about
  /// anything but white noise.
  double missing = 1e-3;
  /// Largest root mean square of the jitter of intervals, in nominal intervals. To first order noise does not depend on
  /// when it was sampled, so that a late stamp here and there does no harm. Stamps that vary more are likely arrival
  /// times.
  double jitter = 0.2;
  /// Accept stamps that are arrival times, with any jitter and with bursts. Only the rate is taken from them.
  bool arrival_times = false;
};

/// Throws std::invalid_argument, saying by how much and where, if the sampling exceeds the limits.
template <TimePoint Time>
void require_regular(const Sampling<Time>& sampling, const SamplingLimits& limits = {}) {
  splinertia::detail::require_non_negative("SamplingLimits", "missing", limits.missing);
  splinertia::detail::require_non_negative("SamplingLimits", "jitter", limits.jitter);
  if (sampling.bursts && !limits.arrival_times) {
    const Bursts& bursts = *sampling.bursts;
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "%.3g samples %.3g s apart, one every %.4g s", bursts.samples,
                  bursts.spacing, bursts.period);
    splinertia::detail::refuse<std::invalid_argument>(
        "sampling: the stamps come in bursts of ", text.data(),
        ": they are arrival times of packets and no sample is missing, expected the "
        "times of the samples");
  }
  if (sampling.jitter > limits.jitter * sampling.nominal_interval && !limits.arrival_times) {
    splinertia::detail::refuse<std::invalid_argument>("sampling: the intervals vary by ", sampling.jitter,
                                                      " s (rms) about ", sampling.nominal_interval,
                                                      " s, expected at most ", limits.jitter * 100, " % of it");
  }
  if (sampling.missing_share() > limits.missing) {
    splinertia::detail::refuse<std::invalid_argument>(
        "sampling: ", sampling.missing, " samples are missing in ", sampling.gaps,
        sampling.gaps == 1 ? " gap" : " gaps", ", the longest of ", sampling.longest.duration, " s after sample ",
        sampling.longest.index, " at time ", splinertia::detail::seconds_or_ticks(sampling.longest.time),
        ", expected at most ", limits.missing * 100, " % of ", sampling.samples + sampling.missing);
  }
}

}  // namespace splinertia::allan
