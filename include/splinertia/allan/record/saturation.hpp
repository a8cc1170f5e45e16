// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <splinertia/allan/integrated_signal.hpp>

namespace splinertia::allan {

/// Samples at the ends of a sensor's range.
struct Saturation {
  std::int64_t lowest = 0;   ///< samples at the lowest value, if it is an end of the range
  std::int64_t highest = 0;  ///< samples at the highest value, likewise

  [[nodiscard]] std::int64_t samples() const { return lowest + highest; }
};

/// Finds clipped samples. A signal is clipped if its extreme value occurs at least 20 times, and five times as often as
/// the value next to it. In noise it occurs less often, however coarse the resolution, because the tails of a
/// distribution fall. One pass.
template <Signal S>
[[nodiscard]] Saturation find_saturation(const S& signal) {
  struct End {
    double value, next;
    std::int64_t count = 0, next_count = 0;

    /// `beyond`: the sample is further out than `value`. `between`: it is between `next` and `value`.
    void add(double sample, bool beyond, bool between) {
      if (beyond) {
        next = value;
        next_count = count;
        value = sample;
        count = 1;
      } else if (sample == value) {
        ++count;
      } else if (between) {
        next = sample;
        next_count = 1;
      } else if (sample == next) {
        ++next_count;
      }
    }
    [[nodiscard]] std::int64_t clipped() const { return count >= 20 && count >= 5 * next_count ? count : 0; }
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  End low{infinity, infinity}, high{-infinity, -infinity};
  for (const auto& sample : signal) {
    const auto value = static_cast<double>(sample);
    low.add(value, value<low.value, value> low.value && value < low.next);
    high.add(value, value > high.value, value < high.value && value > high.next);
  }
  // A signal with two values or fewer has no tails to compare.
  if (low.next == high.value || low.value == high.value) return {};
  return {low.clipped(), high.clipped()};
}

}  // namespace splinertia::allan
