// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/require.hpp>
#include <vector>

namespace splinertia::allan {

/// Whether a sensor was left alone, as far as its own log can tell.
struct Stillness {
  std::int64_t blocks;     ///< that were compared
  std::int64_t disturbed;  ///< in which the samples spread more than four times as much as in most
  std::int64_t worst;      ///< first sample of the block with the largest spread
  double worst_ratio;      ///< its standard deviation over that of most
};

/// Cuts a signal into blocks of `length` samples (about a second, at least 20) and compares the standard deviation in
/// each with the median of all. Noise that does not change never reaches four times, also a random walk next to never;
/// a knock, a hand or a slow turn does. What it does not find: motion that lasts all the time, and drift slower than a
/// block. There is nothing to compare with if most blocks are constant, as with a coarse resolution.
template <Signal S>
[[nodiscard]] Stillness measure_stillness(const S& signal, std::int64_t length) {
  require(length >= 20, "measure_stillness", "length", length, "at least 20 samples");
  std::vector<double> spreads;
  auto value = std::begin(signal);
  for (std::int64_t left = std::distance(value, std::end(signal)); left >= length; left -= length) {
    const auto origin = static_cast<double>(*value);  // so that a large mean takes no digits from the squares
    double sum = 0, squares = 0;
    for (std::int64_t i = 0; i < length; ++i, ++value) {
      const double difference = static_cast<double>(*value) - origin;
      sum += difference;
      squares += difference * difference;
    }
    const auto count = static_cast<double>(length);
    spreads.push_back(std::sqrt(std::max(0.0, (squares - sum * sum / count) / count)));
  }
  Stillness result{static_cast<std::int64_t>(spreads.size()), 0, 0, 1};
  if (spreads.empty()) return result;
  std::vector<double> sorted = spreads;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual = *middle;
  if (usual == 0) return result;
  result.disturbed = std::count_if(spreads.begin(), spreads.end(), [&](double spread) { return spread > 4 * usual; });
  const auto worst = std::max_element(spreads.begin(), spreads.end());
  result.worst = (worst - spreads.begin()) * length;
  result.worst_ratio = *worst / usual;
  return result;
}

}  // namespace splinertia::allan
