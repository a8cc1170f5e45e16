// SPDX-License-Identifier: MIT
#include "support/imu_log_stretches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string_view>

#include "support/concat.hpp"

using namespace splinertia;

namespace {

/// Rows [first, last).
struct Rows {
  std::size_t first, last;
};

/// Parses "10-20.5". A minus sign after an e belongs to the number.
LogSpan parse_span(const std::string& text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] != '-' || text[i - 1] == 'e' || text[i - 1] == 'E') continue;
    const Parsed<double> begin = parse_real(std::string_view(text).substr(0, i));
    const Parsed<double> end = parse_real(std::string_view(text).substr(i + 1));
    if (begin.problem || end.problem || !(begin.value >= 0) || !(begin.value < end.value)) break;
    return {begin.value, end.value};
  }
  throw std::invalid_argument(concat("--leave-out: ", excerpt(text),
                                     ", expected A-B with 0 <= A < B, in seconds from the beginning of the log"));
}

class Clock {
 public:
  Clock(const ImuColumns& columns, std::optional<double> rate) : columns_(columns), rate_(rate) {}

  /// The first row at or after a time in s.
  [[nodiscard]] std::size_t row_at(double time) const {
    const auto rows = static_cast<double>(columns_.rows);
    if (rate_) return static_cast<std::size_t>(std::min(std::ceil(time * *rate_), rows));
    if (!(time <= duration())) return columns_.rows;
    const auto found =
        std::lower_bound(columns_.times.begin(), columns_.times.end(), after(columns_.times.front(), time));
    return static_cast<std::size_t>(found - columns_.times.begin());
  }

  [[nodiscard]] double time_of(std::size_t row) const {
    return rate_ ? static_cast<double>(row) / *rate_ : to_seconds<double>(columns_.times[row] - columns_.times.front());
  }

  [[nodiscard]] double duration() const {
    return rate_ ? static_cast<double>(columns_.rows) / *rate_
                 : to_seconds<double>(columns_.times.back() - columns_.times.front());
  }

 private:
  const ImuColumns& columns_;
  std::optional<double> rate_;
};

/// Sorts them, joins those that touch, and drops empty ones.
void merge(std::vector<Rows>& list) {
  std::erase_if(list, [](const Rows& rows) { return rows.first == rows.last; });
  std::sort(list.begin(), list.end(), [](const Rows& a, const Rows& b) { return a.first < b.first; });
  std::vector<Rows> merged;
  for (const Rows& rows : list) {
    if (!merged.empty() && rows.first <= merged.back().last) {
      merged.back().last = std::max(merged.back().last, rows.last);
    } else {
      merged.push_back(rows);
    }
  }
  list.swap(merged);
}

/// The rows that the options select, merged. Throws std::invalid_argument as leave_out() does.
std::vector<Rows> selected_rows(const Clock& clock, std::size_t all, const ImuLogOptions& options) {
  if (!(std::isfinite(options.skip) && options.skip >= 0)) {
    throw std::invalid_argument(concat("--skip: time is ", options.skip, ", expected a finite number >= 0"));
  }
  std::vector<Rows> removed{{0, clock.row_at(options.skip)}};
  if (removed[0].last + 1 >= all) throw std::invalid_argument(concat("--skip: ", options.skip, " s is the whole log"));
  if (options.until) {
    if (!(std::isfinite(*options.until) && *options.until > 0)) {
      throw std::invalid_argument(concat("--until: time is ", *options.until, ", expected a finite number > 0"));
    }
    removed.push_back({clock.row_at(*options.until), all});
    if (removed[1].first <= removed[0].last) {
      throw std::invalid_argument(concat("--until: ", *options.until, " s, expected more than the ", options.skip,
                                         " s of --skip, with a sample in between"));
    }
  }
  for (const std::string& text : options.leave_out) {
    const LogSpan span = parse_span(text);
    removed.push_back({clock.row_at(span.begin), clock.row_at(span.end)});
    if (removed.back().first == removed.back().last) {
      throw std::invalid_argument(
          concat("--leave-out: ", excerpt(text), " contains no sample, the log is ", clock.duration(), " s long"));
    }
  }
  merge(removed);
  if (!removed.empty() && removed.front().first == 0 && removed.front().last == all) {
    throw std::invalid_argument("--leave-out: this is the whole log");
  }
  return removed;
}

}  // namespace

LeftOut leave_out(ImuColumns& columns, const ImuLogOptions& options, std::optional<double> rate) {
  const Clock clock(columns, rate);
  const std::size_t all = columns.rows;
  const std::vector<Rows> removed = selected_rows(clock, all, options);
  LeftOut result;
  std::size_t kept = 0;
  const auto keep = [&](std::size_t first, std::size_t last) {
    // The time of every 1000th sample is recorded, because stamps drift from the mean rate and samples may be missing.
    constexpr std::size_t step = 1000;
    for (std::size_t row = first; row < last; row += step) {
      result.times.push_back({kept + row - first, clock.time_of(row)});
    }
    kept += last - first;
  };
  std::size_t first = 0;
  for (const Rows& rows : removed) {
    keep(first, rows.first);
    if (rows.first > 0 && rows.last < all) {
      result.inside.push_back({clock.time_of(rows.first), clock.time_of(rows.last)});
      result.rows_inside += rows.last - rows.first;
      result.breaks.push_back(static_cast<std::int64_t>(kept));
    }
    first = rows.last;
  }
  keep(first, all);
  for (auto rows = removed.rbegin(); rows != removed.rend(); ++rows) columns.erase(rows->first, rows->last);
  return result;
}
