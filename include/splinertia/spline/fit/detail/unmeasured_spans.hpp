// SPDX-License-Identifier: MIT
/// Finds the spans of a curve that poses do not determine.
#pragma once

#include <algorithm>
#include <cstddef>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/time.hpp>
#include <vector>

namespace splinertia::detail {

/// A span between two neighbouring poses, or between an end of the curve and the pose next to it.
template <typename Time>
struct UnmeasuredSpan {
  Time start, end;
  bool is_gap;           ///< long compared with the knot interval and with the usual interval of poses
  double knot_interval;  ///< s, of the knots beside it
};

/// A part of a curve with poses, between two unmeasured spans; s from the start of the curve.
struct MeasuredPart {
  double start, end;
};

/// The spans between poses where the curve needs a prior:
/// - gaps: longer than 1.5 knot intervals (of the knots beside the gap) and than 2.5 times the median interval of
///   poses;
/// - every interval influenced by a control point of `weak`, those that the poses determine badly, in ascending order,
///   unless that control point also influences a gap.
/// `counts(i)` tells whether pose i is used.
template <typename Curve>
[[nodiscard]] std::vector<UnmeasuredSpan<typename Curve::Time>> unmeasured_spans(const Curve& curve,
                                                                                 const PosesOf<Curve>& poses,
                                                                                 const auto& counts,
                                                                                 const std::vector<std::size_t>& weak) {
  using Time = typename Curve::Time;
  constexpr int order = Curve::order;
  const auto& knots = curve.knots();
  const std::size_t control_points = curve.control_points().size();
  const auto segment = [&](Time t) { return knots.template basis<double, order, 0>(t, control_points).first; };
  const auto length_of_segment = [&](Time t) {
    const std::size_t s = segment(t);
    return to_seconds<double>(knots.knot(s + 1, order) - knots.knot(s, order));
  };

  std::vector<Time> times{curve.start()};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (counts(i) && poses[i].time > times.back()) times.push_back(poses[i].time);
  }
  if (curve.end() > times.back()) times.push_back(curve.end());
  std::vector<double> lengths;
  for (std::size_t i = 1; i < times.size(); ++i) lengths.push_back(to_seconds<double>(times[i] - times[i - 1]));
  std::vector<double> sorted = lengths;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual = *middle;

  // The shorter of the segments before and after interval i: a long gap may be one segment.
  const auto interval_beside = [&](std::size_t i) {
    const Time before = i > 1 ? times[i - 2] + (times[i - 1] - times[i - 2]) / 2 : times[i - 1];
    return (std::min)(length_of_segment(before), length_of_segment(times[i]));
  };

  std::vector<UnmeasuredSpan<Time>> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const Time start = times[i - 1], end = times[i];
    intervals.push_back({start, end, false, 0});
    if (!(lengths[i - 1] > 2.5 * usual) && times.size() > 2) continue;
    intervals.back().is_gap = lengths[i - 1] > 1.5 * interval_beside(i);
  }
  // A control point influences Order segments. If there is no gap among them, poses are sparse throughout.
  std::vector<bool> sparse(intervals.size(), false);
  const std::size_t segments = control_points - order + 1;
  for (const std::size_t c : weak) {
    const Time from = knots.knot(c + 1 < order ? 0 : c + 1 - order, order);
    const Time to = knots.knot((std::min)(c + 1, segments), order);
    const auto ends_later = [](Time t, const auto& interval) { return t < interval.end; };
    const auto first = std::upper_bound(intervals.begin(), intervals.end(), from, ends_later);
    auto last = first;
    while (last != intervals.end() && last->start < to) ++last;
    if (std::any_of(first, last, [](const auto& interval) { return interval.is_gap; })) continue;
    std::fill(sparse.begin() + (first - intervals.begin()), sparse.begin() + (last - intervals.begin()), true);
  }
  std::vector<UnmeasuredSpan<Time>> spans;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (!intervals[i].is_gap && !sparse[i]) continue;
    spans.push_back(intervals[i]);
    spans.back().knot_interval = interval_beside(i + 1);
  }
  return spans;
}

/// The gaps among the spans. A stretch between two of them, or between one and an end of the curve, that has at most
/// Order poses belongs to the gap: so few poses do not determine its acceleration.
template <typename Curve>
[[nodiscard]] std::vector<FitGap<typename Curve::Time>> reported_gaps(
    const Curve& curve, const PosesOf<Curve>& poses, const auto& counts,
    const std::vector<UnmeasuredSpan<typename Curve::Time>>& spans) {
  const auto few_between = [&](auto from, auto to) {
    const auto earlier = [](const auto& pose, auto time) { return pose.time < time; };
    int count = 0;
    for (auto pose = std::lower_bound(poses.begin(), poses.end(), from, earlier);
         pose != poses.end() && pose->time <= to && count <= Curve::order; ++pose) {
      count += counts(static_cast<std::size_t>(pose - poses.begin())) ? 1 : 0;
    }
    return count <= Curve::order;
  };
  std::vector<FitGap<typename Curve::Time>> gaps;
  for (const auto& span : spans) {
    if (!span.is_gap) continue;
    const auto before = gaps.empty() ? curve.start() : gaps.back().end;
    if (!few_between(before, span.start)) {
      gaps.push_back({span.start, span.end});
    } else if (gaps.empty()) {
      gaps.push_back({before, span.end});
    } else {
      gaps.back().end = span.end;
    }
  }
  if (!gaps.empty() && few_between(gaps.back().end, curve.end())) gaps.back().end = curve.end();
  return gaps;
}

/// The parts of the curve between the spans: one more than there are spans. A part with a single pose has length 0.
template <typename Curve>
[[nodiscard]] std::vector<MeasuredPart> measured_parts(const Curve& curve,
                                                       const std::vector<UnmeasuredSpan<typename Curve::Time>>& spans) {
  const auto since_start = [&](auto time) { return to_seconds<double>(time - curve.start()); };
  std::vector<MeasuredPart> parts;
  double from = 0;
  for (const auto& span : spans) {
    parts.push_back({from, since_start(span.start)});
    from = since_start(span.end);
  }
  parts.push_back({from, since_start(curve.end())});
  return parts;
}

}  // namespace splinertia::detail
