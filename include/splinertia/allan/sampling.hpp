// SPDX-License-Identifier: MIT
/// How regularly a log was sampled, which an Allan analysis takes for granted.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ranges>
#include <splinertia/finite.hpp>
#include <splinertia/message.hpp>
#include <splinertia/require.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <vector>

namespace splinertia::allan {

/// From one sample to the next.
template <TimePoint Time>
struct StampInterval {
  std::int64_t index;  ///< of the sample that it begins with, from 0
  Time time;           ///< of that sample
  double duration;     ///< s
};

template <TimePoint Time>
struct Sampling {
  std::int64_t samples;
  double rate;                  ///< Hz, of the sensor: samples that are missing are counted
  double nominal_interval;      ///< median of the intervals, s
  double jitter;                ///< of the intervals about the nominal one, without gaps: root mean square, s
  double largest_jitter;        ///< s
  StampInterval<Time> longest;  ///< of all intervals
  std::int64_t gaps;            ///< intervals longer than 1.5 nominal ones
  std::int64_t missing;         ///< samples that have a place in them

  /// Of the samples that there should be, how many are missing.
  [[nodiscard]] double missing_share() const {
    return static_cast<double>(missing) / static_cast<double>(samples + missing);
  }
};

/// Reads time stamps: seconds, or an integer std::chrono::duration. Throws std::invalid_argument for fewer than 3, and
/// for stamps that are not finite or do not increase, naming the first of them. Memory: a double for each.
template <std::ranges::forward_range Stamps>
  requires TimePoint<std::ranges::range_value_t<Stamps>>
[[nodiscard]] Sampling<std::ranges::range_value_t<Stamps>> measure_sampling(const Stamps& stamps) {
  using Time = std::ranges::range_value_t<Stamps>;
  std::vector<double> intervals;
  std::optional<Time> first, last;
  StampInterval<Time> longest{};
  for (const Time& time : stamps) {
    const auto index = static_cast<std::int64_t>(intervals.size()) + (last ? 1 : 0);
    if constexpr (std::floating_point<Time>) {
      if (!is_finite(time)) {
        throw std::invalid_argument(message("sampling: stamp ", index, " is ", time, ", expected a finite number"));
      }
    } else if (first && *first < Time::zero() && time > Time::max() + *first) {
      throw std::invalid_argument(message("sampling: stamp ", index, " is ", printable(time), " and the first ",
                                          printable(*first), ", expected a difference that their type can hold"));
    }
    if (last) {
      if (!(*last < time)) {
        throw std::invalid_argument(message("sampling: stamp ", index, " is ", printable(time), " after ",
                                            printable(*last), ", expected increasing stamps"));
      }
      intervals.push_back(seconds<double>(time - *last));
      if (intervals.back() > longest.duration) longest = {index - 1, *last, intervals.back()};
    } else {
      first = time;
    }
    last = time;
  }
  if (intervals.size() < 2) {
    throw std::invalid_argument(
        message("sampling: ", intervals.size() + (last ? 1 : 0), " stamps, expected at least 3"));
  }

  std::vector<double> sorted = intervals;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double nominal = *middle;
  Sampling<Time> result{static_cast<std::int64_t>(intervals.size()) + 1, 0, nominal, 0, 0, longest, 0, 0};
  double squares = 0;
  for (const double interval : intervals) {
    if (interval > 1.5 * nominal) {
      ++result.gaps;
      result.missing += std::llround(interval / nominal) - 1;
    } else {
      squares += (interval - nominal) * (interval - nominal);
      result.largest_jitter = std::max(result.largest_jitter, std::abs(interval - nominal));
    }
  }
  // The median is no longer than 1.5 times itself, so that some interval is no gap.
  result.jitter = std::sqrt(squares / static_cast<double>(result.samples - 1 - result.gaps));
  result.rate = static_cast<double>(result.samples - 1 + result.missing) / seconds<double>(*last - *first);
  return result;
}

/// How irregular a log may be that is analysed as if its samples were equally spaced.
struct SamplingLimits {
  /// Share of the samples. The samples on both sides of a gap are taken for neighbours, nothing is made up in between.
  /// That leaves white noise as it is, which a gap filled by interpolation would not, since it knows of no order; the
  /// averaging times and K² are off by the missing share. What it breaks is where the order counts: the random walk
  /// steps by a whole gap at once, the errors of quantization no longer cancel, and a long gap is often no gap of the
  /// stamps alone, but a sensor that was started anew with another bias. With one sample in a thousand that is below
  /// the uncertainty of what an hour at rest says about anything but white noise.
  double missing = 1e-3;
  /// Root mean square, in nominal intervals. Noise does not mind when it was sampled to first order, so that a late
  /// stamp here and there does no harm; from about here on late stamps (beyond 1.5 intervals) look like missing
  /// samples.
  double jitter = 0.2;
};

/// Throws std::invalid_argument, saying by how much and where, unless the sampling is within the limits.
template <TimePoint Time>
void require_regular(const Sampling<Time>& sampling, const SamplingLimits& limits = {}) {
  require_non_negative("SamplingLimits", "missing", limits.missing);
  require_non_negative("SamplingLimits", "jitter", limits.jitter);
  if (sampling.missing_share() > limits.missing) {
    throw std::invalid_argument(message("sampling: ", sampling.missing, " samples are missing in ", sampling.gaps,
                                        sampling.gaps == 1 ? " gap" : " gaps", ", the longest of ",
                                        sampling.longest.duration, " s after sample ", sampling.longest.index,
                                        " at time ", printable(sampling.longest.time), ", expected at most ",
                                        limits.missing * 100, " % of ", sampling.samples + sampling.missing));
  }
  if (sampling.jitter > limits.jitter * sampling.nominal_interval) {
    throw std::invalid_argument(message("sampling: the intervals vary by ", sampling.jitter, " s (rms) about ",
                                        sampling.nominal_interval, " s, expected at most ", limits.jitter * 100,
                                        " % of it"));
  }
}

}  // namespace splinertia::allan
