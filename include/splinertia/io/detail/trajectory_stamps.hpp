// SPDX-License-Identifier: MIT
/// The stamps of a trajectory file: whether their unit is plausible, and which of them are wrong.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <splinertia/io/stamp_unit.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <string>
#include <vector>

namespace splinertia::detail {

inline constexpr RateRange pose_rates{0.01, 20e3};

/// Whether a typical step, in this unit, is plausible for poses. An unknown one (0) is.
[[nodiscard]] inline bool is_plausible(double step, TimeUnit unit) { return is_plausible(step, unit, pose_rates); }

/// A time as text in a unit, with as many decimals as needed.
[[nodiscard]] inline std::string stamp_text(std::chrono::nanoseconds time, TimeUnit unit) {
  std::uint64_t factor = 1;
  for (int place = static_cast<int>(unit); place < 9; ++place) factor *= 10;
  const bool negative = time.count() < 0;
  const std::uint64_t count =
      negative ? -static_cast<std::uint64_t>(time.count()) : static_cast<std::uint64_t>(time.count());
  std::string text = (negative ? "-" : "") + std::to_string(count / factor);
  if (factor > 1 && count % factor != 0) {
    text += '.' + std::to_string(factor + count % factor).substr(1);
    while (text.ends_with('0')) text.pop_back();
  }
  return text;
}

/// b − a in ns, for a ≤ b; it may be more than a signed integer holds.
[[nodiscard]] inline std::uint64_t stamp_distance(std::chrono::nanoseconds a, std::chrono::nanoseconds b) {
  return static_cast<std::uint64_t>(b.count()) - static_cast<std::uint64_t>(a.count());
}

/// The indices of the fewest stamps to leave out such that the rest increases. Of equal choices, earlier stamps stay.
[[nodiscard]] inline std::vector<std::size_t> out_of_order(std::span<const std::chrono::nanoseconds> times) {
  constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();
  std::vector<std::size_t> ends, before(times.size(), none);  // of the best increasing choice of each length
  std::size_t kept = none;                                    // the first end of the longest
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto place =
        std::partition_point(ends.begin(), ends.end(), [&](std::size_t k) { return times[k] < times[i]; });
    if (place != ends.end() && times[*place] == times[i]) continue;
    if (place != ends.begin()) before[i] = *(place - 1);
    if (place == ends.end()) {
      ends.push_back(i);
      kept = i;
    } else {
      *place = i;
    }
  }
  std::vector<std::size_t> left_out;
  for (std::size_t i = times.size(); i-- > 0;) {
    if (i == kept) {
      kept = before[i];
    } else {
      left_out.push_back(i);
    }
  }
  return {left_out.rbegin(), left_out.rend()};
}

/// How many stamps at the beginning and at the end of an increasing list are absurdly far from the rest. A step of more
/// than a minute and of more than a thousand times the span of the rest separates them. At either end they are at most
/// a hundredth of all, or one in a short list; lists of fewer than 5 have none. Clocks that are not yet set write such
/// stamps.
struct FarStamps {
  std::size_t first = 0, last = 0;

  explicit FarStamps(std::span<const std::chrono::nanoseconds> times) {
    const std::size_t n = times.size(), side = std::max<std::size_t>(1, n / 100);
    if (n < 5) return;
    const double span = static_cast<double>(stamp_distance(times[side], times[n - 1 - side]));
    const double limit = (std::max)(60e9, 1000 * span);
    for (std::size_t i = 0; i < side; ++i) {
      if (static_cast<double>(stamp_distance(times[i], times[i + 1])) > limit) first = i + 1;
      if (static_cast<double>(stamp_distance(times[n - 2 - i], times[n - 1 - i])) > limit) last = i + 1;
    }
  }
};

}  // namespace splinertia::detail
