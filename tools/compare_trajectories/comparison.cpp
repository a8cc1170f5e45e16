// SPDX-License-Identifier: MIT
#include "compare_trajectories/comparison.hpp"

#include <cmath>
#include <splinertia/evaluation/trajectory_drift.hpp>
#include <splinertia/evaluation/trajectory_pairs.hpp>
#include <splinertia/time.hpp>
#include <splinertia/units.hpp>
#include <stdexcept>
#include <utility>

#include "support/concat.hpp"
#include "support/formatted.hpp"

using namespace splinertia;

namespace {

using Errors = std::vector<PoseError<double>>;

void shift(Poses& poses, double offset) {
  for (auto& pose : poses) pose.time = after(pose.time, offset);
}

/// Adds the rows of a metric: translation errors divided by `size`, with the label `unit`, and rotation errors in
/// degrees, with the label `rotation_unit`.
void add_rows(std::vector<Row>& rows, const std::string& metric, const Errors& errors, const std::string& unit,
              double size, const std::string& rotation_unit) {
  const auto translation = [size](const PoseError<double>& e) { return e.translation / size; };
  const auto degrees = [](const PoseError<double>& e) { return e.rotation / units::degree; };
  rows.push_back({metric, "translation", unit, error_statistics(errors, translation)});
  rows.push_back({metric, "rotation", rotation_unit, error_statistics(errors, degrees)});
}

/// The index pairs of RPE; empty if the trajectory is too short.
IndexPairs index_pairs(const Pairs& pairs, const Options& o) {
  const PairSelection selection = o.all_pairs ? PairSelection::all : PairSelection::consecutive;
  try {
    if (o.unit == "m") return index_pairs_by_path(pairs, o.delta, selection);
    if (o.unit == "s") return index_pairs_by_time(pairs, o.delta, selection);
    return index_pairs_by_frames(pairs.size(), static_cast<std::size_t>(o.delta), selection);
  } catch (const std::invalid_argument&) {  // delta is valid, so the trajectory is too short
    return {};
  }
}

void add_relative(Comparison& c, const Options& o) {
  const IndexPairs indices = index_pairs(c.pairs, o);
  if (indices.empty()) {
    c.no_relative = concat("no two of the ", c.pairs.size(), " pairs are ", o.delta, ' ', o.unit,
                           o.unit == "m" ? " of path" : "", " apart (--delta, --delta-unit)");
    return;
  }
  add_rows(c.rows, "RPE", relative_errors(c.pairs, indices), "m", 1, "deg");
}

void add_drift(Comparison& c, const Options& o) {
  Errors all;
  std::string too_long;
  for (const double length : o.lengths) {
    const Errors errors = drift_errors(c.pairs, length);
    if (errors.empty()) {
      too_long += concat(' ', length);
      continue;
    }
    add_rows(c.rows, concat("drift ", length, " m"), errors, "%", units::percent, "deg/m");
    all.insert(all.end(), errors.begin(), errors.end());
  }
  const double path = reference_path(c.pairs).back();
  if (all.empty()) {
    c.no_drift = formatted("no drift: the reference's path of %.4g m is shorter than every length (--lengths)", path);
    return;
  }
  add_rows(c.rows, "drift", all, "%", units::percent, "deg/m");
  if (!too_long.empty()) {
    c.no_drift =
        formatted("no drift over%s m: the reference's path is %.4g m long (--lengths)", too_long.c_str(), path);
  }
}

}  // namespace

Comparison compare(const Poses& reference, Poses estimate, const Options& o) {
  Comparison c{};
  c.time_offset = o.time_offset;
  if (o.time_offset != 0) shift(estimate, o.time_offset);
  if (o.estimate_time_offset) {
    try {
      c.estimated_offset = estimate_time_offset(reference, estimate, {.range = o.time_offset_range});
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(
          concat("--estimate-time-offset: ", error.what(), " (--time-offset, --time-offset-range)"));
    }
    c.time_offset += c.estimated_offset->offset;
    shift(estimate, c.estimated_offset->offset);
  }
  const Pairs associated = associate(reference, estimate, o.max_difference);
  try {
    c.transform = alignment(associated, alignments.at(o.align), o.align_poses.value_or(associated.size()));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(concat("--align ", o.align, ": ", error.what()));
  }
  c.pairs = transformed(associated, c.transform);
  c.absolute = absolute_errors(c.pairs);
  add_rows(c.rows, "ATE", c.absolute, "m", 1, "deg");
  add_relative(c, o);
  add_drift(c, o);
  return c;
}
