// SPDX-License-Identifier: MIT
/// The pairs of poses between which relative errors are taken.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace splinertia {

/// Pairs of indices: a relative error is taken from the first index to the second.
using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// consecutive: one pair after the other, (0, d) (d, 2d) …; all: a pair from every index, overlapping.
enum class PairSelection { consecutive, all };

/// Pairs of indices `delta` apart, from 0 to size − 1. Throws std::invalid_argument for delta = 0 and if there are no
/// pairs.
[[nodiscard]] inline IndexPairs index_pairs_by_frames(std::size_t size, std::size_t delta,
                                                      PairSelection selection = PairSelection::consecutive) {
  IndexPairs indices;
  const std::size_t step = selection == PairSelection::all ? 1 : delta;
  if (delta > 0) {
    for (std::size_t i = 0; i < size && size - i > delta; i += step) indices.emplace_back(i, i + delta);
  }
  if (indices.empty()) {
    detail::refuse<std::invalid_argument>("index_pairs_by_frames: delta ", delta,
                                          ", expected at least 1 and less than ", size, ", the number of poses");
  }
  return indices;
}

namespace detail {

/// The consecutive pairs of index_pairs_by_path(). lengths[i]: from pose i to pose i + 1, m.
template <typename Scalar>
[[nodiscard]] IndexPairs consecutive_pairs_by_path(const std::vector<Scalar>& lengths, const Scalar& delta) {
  IndexPairs indices;
  std::size_t start = 0;
  Scalar path(0);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    path += lengths[i];
    if (!(path >= delta)) continue;
    indices.emplace_back(start, i + 1);
    start = i + 1;
    path = Scalar(0);
  }
  return indices;
}

/// All pairs of index_pairs_by_path(). lengths[i]: from pose i to pose i + 1, m.
template <typename Scalar>
[[nodiscard]] IndexPairs all_pairs_by_path(const std::vector<Scalar>& lengths, const Scalar& delta,
                                           const Scalar& tolerance) {
  using std::abs;
  IndexPairs indices;
  std::vector<Scalar> path{Scalar(0)};
  for (const Scalar& length : lengths) path.push_back(path.back() + length);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const auto miss = [&](auto at) { return abs(*at - path[i] - delta); };
    const auto next = path.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    auto best = std::partition_point(next, path.end(), [&](Scalar s) { return s - path[i] < delta; });
    // The one before may be as good or better. Of several with the same path length, take the first.
    if (best == path.end() || (best != next && miss(best - 1) <= miss(best))) {
      best = std::lower_bound(next, path.end(), *(best - 1));
    }
    if (miss(best) <= delta * tolerance) indices.emplace_back(i, static_cast<std::size_t>(best - path.begin()));
  }
  return indices;
}

}  // namespace detail

/// Pairs of indices between which the estimate's path is `delta` metres long. Consecutive: to the first index at which
/// it is at least that long; the next pair begins there. All: to the index at which its length is nearest to delta, if
/// it differs by at most tolerance · delta. Throws std::invalid_argument unless delta is finite and > 0, and if there
/// are no pairs.
template <Pose G, TimePoint Time>
[[nodiscard]] IndexPairs index_pairs_by_path(const std::vector<PosePair<G, Time>>& pairs,
                                             std::type_identity_t<ScalarOf<G>> delta,
                                             PairSelection selection = PairSelection::consecutive,
                                             std::type_identity_t<ScalarOf<G>> tolerance = ScalarOf<G>(1) /
                                                                                           ScalarOf<G>(10)) {
  if (!(delta > ScalarOf<G>(0)) || !detail::is_finite(delta)) {
    detail::refuse<std::invalid_argument>("index_pairs_by_path: delta ", delta, " m, expected a length > 0");
  }
  std::vector<ScalarOf<G>> lengths;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    lengths.push_back((position(pairs[i].estimate) - position(pairs[i - 1].estimate)).norm());
  }
  const IndexPairs indices = selection == PairSelection::consecutive
                                 ? detail::consecutive_pairs_by_path(lengths, delta)
                                 : detail::all_pairs_by_path(lengths, delta, tolerance);
  if (indices.empty()) {
    detail::refuse<std::invalid_argument>("index_pairs_by_path: no two of the ", pairs.size(), " poses are ", delta,
                                          " m apart along the path");
  }
  return indices;
}

/// Pairs of indices `delta` seconds apart: to the pose whose time difference is nearest to delta, if it differs by at
/// most tolerance · delta. Consecutive: each pair begins where the one before ends or, after a gap, with the next pose
/// that has a partner. All: a pair from every pose, as in evaluate_rpe.py of the TUM RGB-D benchmark. Throws
/// std::invalid_argument unless delta is finite and > 0, and if there are no pairs.
template <Pose G, TimePoint Time>
[[nodiscard]] IndexPairs index_pairs_by_time(const std::vector<PosePair<G, Time>>& pairs, double delta,
                                             PairSelection selection = PairSelection::consecutive,
                                             double tolerance = 0.1) {
  using std::abs;
  if (!(delta > 0) || !detail::is_finite(delta)) {
    detail::refuse<std::invalid_argument>("index_pairs_by_time: delta ", delta, " s, expected a duration > 0");
  }
  IndexPairs indices;
  for (std::size_t i = 0; i + 1 < pairs.size();) {
    const auto since = [&](const auto& pair) {
      return to_seconds<double>(detail::time_between(pairs[i].time, pair.time));
    };
    const auto miss = [&](auto at) { return abs(since(*at) - delta); };
    const auto next = pairs.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    auto best = std::partition_point(next, pairs.end(), [&](const auto& pair) { return since(pair) < delta; });
    if (best == pairs.end() || (best != next && miss(best - 1) <= miss(best))) --best;
    const auto j = static_cast<std::size_t>(best - pairs.begin());
    const bool nearby = miss(best) <= delta * tolerance;
    if (nearby) indices.emplace_back(i, j);
    i = nearby && selection == PairSelection::consecutive ? j : i + 1;
  }
  if (indices.empty()) {
    detail::refuse<std::invalid_argument>("index_pairs_by_time: no two of the ", pairs.size(), " poses are ", delta,
                                          " s apart");
  }
  return indices;
}

}  // namespace splinertia
