// SPDX-License-Identifier: MIT
#include "support/imu_log_stamps.hpp"

#include <array>
#include <splinertia/io/stamp_unit.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "support/concat.hpp"
#include "support/formatted.hpp"

using namespace splinertia;

namespace {

constexpr RateRange imu_rates{2, 50e3};     // Hz
constexpr double shortest_log = 1;          // s
constexpr std::size_t enough_stamps = 100;  // fewer are too uncertain, and too short a log to analyse

/// "--time-unit ms (200 Hz)": the units other than `unit` in which the rate would be plausible for an IMU. `rate` is
/// that of the stamps in `unit`.
std::string plausible_units(double rate, double duration, TimeUnit unit) {
  std::string text;
  for (const TimeUnit other : all_time_units) {
    const double longer = seconds_of(other) / seconds_of(unit);
    if (other == unit || duration * longer < shortest_log) continue;
    if (!is_plausible(longer / rate, TimeUnit::seconds, imu_rates)) continue;
    text += concat(text.empty() ? "" : " or ", "--time-unit ", time_unit_name(other), " (",
                   formatted("%.4g", rate / longer), " Hz)");
  }
  return text.empty() ? "expected another --time-unit" : "give " + text;
}

std::string too_fast(double rate, std::optional<TimeUnit> unit) {
  return concat("sampling: ", formatted("%.4g", rate), " Hz",
                unit ? concat(" if the times are in ", time_unit_name(*unit)) : "", ", expected at most ",
                imu_rates.highest, " Hz for an IMU");
}

}  // namespace

StampUnit choose_stamp_unit(std::span<const std::string> first_stamps, std::optional<TimeUnit> usual,
                            const std::string& where) {
  const StampSample sample(std::vector<std::string_view>(first_stamps.begin(), first_stamps.end()));
  const auto plausible = [&](TimeUnit unit) { return is_plausible(sample.mean_step, unit, imu_rates); };
  const bool few = first_stamps.size() < enough_stamps;
  const auto since_1970 = sample.since_1970();
  const bool has_format = usual.has_value() && !sample.fractions;
  if (!has_format && since_1970 && plausible(*since_1970)) {
    if (since_1970 == TimeUnit::seconds && !usual) return {TimeUnit::seconds, ""};
    return {*since_1970, concat("times in ", time_unit_name(*since_1970), " since 1970, as their digits ",
                                sample.decimals ? "and decimals " : "", "show")};
  }
  if (!has_format && sample.decimals && plausible(TimeUnit::seconds)) {
    return {TimeUnit::seconds, usual ? "times in s, as they have decimals" : ""};
  }
  const TimeUnit unit = usual.value_or(TimeUnit::seconds);
  const auto rate_in = [&](TimeUnit in) { return 1 / (sample.mean_step * seconds_of(in)); };
  const double rate = sample.mean_step > 0 ? rate_in(unit) : imu_rates.lowest;
  if (few || (usual ? rate <= imu_rates.highest : plausible(unit))) return {unit, ""};
  const std::string way_out =
      since_1970 && plausible(*since_1970)
          ? concat("give --time-unit ", time_unit_name(*since_1970), formatted(" (%.4g Hz)", rate_in(*since_1970)))
          : plausible_units(rate, 1e9 * shortest_log, unit);
  if (usual) throw std::runtime_error(concat(where, ": ", too_fast(rate, unit), "; ", way_out));
  throw std::runtime_error(concat(where, ": the unit of the times is unknown: the samples would have ",
                                  rates_text(sample.mean_step), "; ", way_out));
}

void require_plausible_times(const LogSampling& sampling, std::optional<TimeUnit> unit) {
  const double duration = static_cast<double>(sampling.samples) / sampling.rate;
  if (sampling.samples < static_cast<std::int64_t>(enough_stamps)) return;
  const std::string way_out = unit ? "; " + plausible_units(sampling.rate, duration, *unit) : "";
  if (sampling.rate > imu_rates.highest) throw std::runtime_error(too_fast(sampling.rate, unit) + way_out);
  if (duration < shortest_log) {
    throw std::runtime_error(concat("sampling: the log lasts ", formatted("%.4g", duration), " s",
                                    unit ? concat(" if the times are in ", time_unit_name(*unit)) : "",
                                    ", expected at least ", shortest_log, " s", way_out));
  }
}
