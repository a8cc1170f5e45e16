// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/sample_span.hpp>
#include <vector>

namespace splinertia::allan {

/// Whether all samples have the same value: a dead axis, which IntegratedSignal refuses. True for no samples.
template <Signal S>
[[nodiscard]] bool is_constant(const S& signal) {
  const auto begin = std::begin(signal), end = std::end(signal);
  return std::all_of(begin, end, [&](const auto& value) { return value == *begin; });
}

/// The spans in which a signal does not change at all although it usually does, in order.
template <Signal S>
[[nodiscard]] std::vector<SampleSpan> find_freezes(const S& signal) {
  constexpr std::int64_t shortest = 50, factor = 4, fewest_others = 20, others_for_each = 10;
  std::vector<SampleSpan> runs;  // of equal values, as long as they matter
  std::int64_t count = 0, index = 0, begin = 0;
  const auto close_run = [&] {
    ++count;
    if (index - begin >= shortest / factor) runs.push_back({begin, index});
    begin = index;
  };
  const auto end = std::end(signal);
  for (auto value = std::begin(signal), last = value; value != end; last = value, ++value, ++index) {
    if (index > begin && !(*value == *last)) close_run();
  }
  if (index > begin) close_run();
  std::vector<std::int64_t> lengths;
  for (const SampleSpan& run : runs) lengths.push_back(run.size());
  std::sort(lengths.begin(), lengths.end());
  std::int64_t usual = shortest / factor, longer = static_cast<std::int64_t>(lengths.size());
  for (const std::int64_t length : lengths) {
    const bool few = count - longer >= fewest_others && (count - longer) >= others_for_each * longer;
    if (few && length >= shortest && length >= factor * usual) {
      std::erase_if(runs, [&](const SampleSpan& run) { return run.size() < length; });
      return runs;
    }
    usual = length;
    --longer;
  }
  return {};
}

}  // namespace splinertia::allan
