// SPDX-License-Identifier: MIT
/// Infers the unit of time stamps in text from their digits and steps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace splinertia {

/// The plausible rates of a kind of data, Hz. A rate outside makes the unit of its stamps doubtful.
struct RateRange {
  double lowest, highest;
};

inline constexpr std::array all_time_units{TimeUnit::seconds, TimeUnit::milliseconds, TimeUnit::microseconds,
                                           TimeUnit::nanoseconds};

/// A unit in seconds.
[[nodiscard]] inline double seconds_of(TimeUnit unit) { return std::pow(10.0, -static_cast<int>(unit)); }

/// Whether stamps with this typical step, in this unit, have such a rate. An unknown step (0) is plausible.
[[nodiscard]] inline bool is_plausible(double step, TimeUnit unit, const RateRange& rates) {
  const double interval = step * seconds_of(unit);
  return step == 0 || (interval >= 1 / rates.highest && interval <= 1 / rates.lowest);
}

/// "0.2 Hz in s, 200 Hz in ms …": the rate that stamps with this step would have in each unit.
[[nodiscard]] inline std::string rates_text(double step) {
  std::string text;
  for (const TimeUnit unit : all_time_units) {
    char rate[number_text_size];
    std::snprintf(rate, sizeof rate, "%.4g", 1 / (step * seconds_of(unit)));
    text += detail::message(text.empty() ? "" : ", ", rate, " Hz in ", time_unit_name(unit));
  }
  return text;
}

/// Properties of the first stamps of a file.
struct StampSample {
  double step = 0;         ///< the median of the positive steps, in their unit; 0 if there is none
  double mean_step = 0;    ///< the mean of the same; if samples come in bursts, the median does not show the rate
  double middle = 0;       ///< the median stamp
  bool decimals = false;   ///< some are written with decimals
  bool fractions = false;  ///< some are not whole numbers

  /// Texts that are not numbers are skipped.
  explicit StampSample(std::span<const std::string_view> texts) {
    std::vector<double> values, steps;
    for (const std::string_view text : texts) {
      const Parsed<double> value = parse_real(text);
      if (value.problem) continue;
      fractions = fractions || value.value != std::floor(value.value);
      decimals = decimals || fractions || text.find('.') < text.find_first_of("eE");
      if (!values.empty() && value.value > values.back()) steps.push_back(value.value - values.back());
      values.push_back(value.value);
    }
    step = median(steps);
    for (const double positive : steps) mean_step += positive / static_cast<double>(steps.size());
    middle = median(values);
  }

  /// The unit in which the stamps count from 1970: s, ms, us or ns if they have 10, 13, 16 or 19 digits.
  [[nodiscard]] std::optional<TimeUnit> since_1970() const {
    for (const TimeUnit unit : all_time_units) {
      const double count = middle * seconds_of(unit);
      if (count >= 1e9 && count < 1e10) return unit;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] static double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }
};

}  // namespace splinertia
