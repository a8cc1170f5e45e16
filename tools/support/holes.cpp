// SPDX-License-Identifier: MIT
#include "support/holes.hpp"

#include <algorithm>
#include <splinertia/time.hpp>

#include "support/concat.hpp"
#include "support/csv_table.hpp"
#include "support/formatted.hpp"

using splinertia::to_seconds;
using std::chrono::nanoseconds;

std::optional<std::size_t> hole_at(const std::vector<Hole>& holes, nanoseconds time) {
  const auto next = std::upper_bound(holes.begin(), holes.end(), time,
                                     [](nanoseconds t, const Hole& hole) { return t <= hole.start; });
  if (next == holes.begin() || time >= std::prev(next)->end) return std::nullopt;
  return static_cast<std::size_t>(next - holes.begin() - 1);
}

std::vector<std::string> hole_lines(const std::vector<Hole>& holes, nanoseconds first, std::size_t most,
                                    const std::vector<std::string>& what) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    if (i == most) {
      lines.push_back(formatted("and %zu more", holes.size() - most));
      break;
    }
    const auto [start, end] = holes[i];
    lines.push_back(formatted("%.3f - %.3f s", to_seconds<double>(start - first), to_seconds<double>(end - first)));
    if (!what.empty()) lines.back() += ": " + what[i];
  }
  return lines;
}

void write_holes(splinertia::AtomicFile& file, const std::vector<Hole>& holes) {
  CsvTable table(file, {"#start [ns]", "end [ns]", "length [s]"});
  for (const auto& [start, end] : holes) table.row(start, end, short_number(to_seconds<double>(end - start)));
}

std::string hole_comment(const Hole& hole) {
  return concat("hole from ", hole.start.count(), " to ", hole.end.count(),
                " ns: no poses, the readings in it are invented");
}
