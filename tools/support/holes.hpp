// SPDX-License-Identifier: MIT
// Holes: time spans without poses, in which a curve is not measured.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <string>
#include <vector>

/// From the last pose before the hole to the first one after it. At these two poses the curve is measured.
struct Hole {
  std::chrono::nanoseconds start, end;
};

/// The index of the hole that a time is inside of. `holes` ascend and do not overlap.
[[nodiscard]] std::optional<std::size_t> hole_at(const std::vector<Hole>& holes, std::chrono::nanoseconds time);

/// A line like "79.330 - 79.835 s" for each of the first `most` holes, in seconds from `first`. `what` is empty, or has
/// a remark for each hole.
[[nodiscard]] std::vector<std::string> hole_lines(const std::vector<Hole>& holes, std::chrono::nanoseconds first,
                                                  std::size_t most, const std::vector<std::string>& what = {});

/// Writes gaps.csv: start, end and length of each hole.
void write_holes(splinertia::AtomicFile& file, const std::vector<Hole>& holes);

/// The comment before the readings in a hole: "hole from 4995000000 to 6000000000 ns: no poses, ...".
[[nodiscard]] std::string hole_comment(const Hole& hole);
