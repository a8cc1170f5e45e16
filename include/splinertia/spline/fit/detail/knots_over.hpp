// SPDX-License-Identifier: MIT
/// Knots for a curve over stamped poses, and the curve that fit() starts from.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/spline/fit/detail/pose_between.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/uniform_knots.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// Throws std::invalid_argument, naming the option, unless the options are valid for this number of poses.
template <typename Curve>
void check(const FitOptions<Curve>& options, std::size_t poses) {
  const auto all_positive = [](const auto& values) {
    bool positive = true;
    for (int i = 0; i < values.size(); ++i) positive = positive && values[i] > 0 && is_finite(values[i]);
    return positive;
  };
  if (poses < 2) refuse<std::invalid_argument>("fit: ", poses, " poses, expected at least 2");
  if (options.knots && options.knot_interval) {
    refuse<std::invalid_argument>("fit: expected knot_interval or knots, and not both");
  }
  if (options.knot_interval) require_positive("fit", "knot_interval", *options.knot_interval);
  if (options.standard_deviation && !all_positive(*options.standard_deviation)) {
    refuse<std::invalid_argument>("fit: expected every component of standard_deviation to be a finite number > 0");
  }
  if (!options.weights.empty() && options.weights.size() != poses) {
    refuse<std::invalid_argument>("fit: ", options.weights.size(), " weights for ", poses,
                                  " poses, expected one each, or none");
  }
  for (std::size_t i = 0; i < options.weights.size(); ++i) {
    if (!(options.weights[i] >= 0) || !is_finite(options.weights[i])) {
      refuse<std::invalid_argument>("fit: weight ", i, " is ", options.weights[i], ", expected a finite number >= 0");
    }
  }
  if (options.smoothness) {
    const int derivative = options.smoothness->derivative;
    if (derivative < 2 || derivative > 3 || derivative >= Curve::order) {
      refuse<std::invalid_argument>("fit: smoothness of derivative ", derivative,
                                    ", expected 2 or 3, and less than the order, ", Curve::order);
    }
    if (!all_positive(options.smoothness->density)) {
      refuse<std::invalid_argument>("fit: expected every component of smoothness.density to be a finite number > 0");
    }
  }
  require_positive("fit", "outlier_limit", options.outlier_limit);
  require(options.most_iterations > 0, "fit", "most_iterations", options.most_iterations, "at least 1");
}

/// Knots of `segments` equal segments from `first` to `last`. UniformKnots may end a little later: by rounding, or with
/// integer time by less than one tick per segment.
template <typename K>
[[nodiscard]] K even_knots(typename K::Time first, typename K::Time last, std::size_t segments, int order) {
  using Time = typename K::Time;
  if constexpr (requires(const K& knots) { knots.interval; }) {
    if constexpr (std::floating_point<Time>) {
      K knots{first, (last - first) / static_cast<Time>(segments)};
      while (knots.knot(segments, order) < last) knots.interval = next_time(knots.interval);
      return knots;
    } else {
      const auto count = static_cast<typename Time::rep>(segments);
      const Time span = last - first;
      return {first, span / count + Time(span % count > Time::zero() ? 1 : 0)};
    }
  } else {
    // Multiplicity k at both ends: the curve begins at its first and ends at its last control point.
    std::vector<Time> knots(static_cast<std::size_t>(order - 1), first);
    const double length = to_seconds<double>(last - first) / static_cast<double>(segments);
    for (std::size_t i = 0; i < segments; ++i) knots.push_back(after(first, static_cast<double>(i) * length));
    knots.insert(knots.end(), static_cast<std::size_t>(order), last);
    return {std::move(knots)};
  }
}

/// The number of segments of this length that cover a span: span/interval if that is an integer up to rounding. Both in
/// s. Throws std::invalid_argument if they are more than a hundred per pose.
[[nodiscard]] inline std::size_t segment_count(double span, double interval, std::size_t poses) {
  const double segments = (std::max)(1.0, std::ceil(span / interval * (1 - 1e-9)));
  const double most = 100 * static_cast<double>(poses);
  if (!(segments <= most)) {
    refuse<std::invalid_argument>("fit: knots ", interval, " s apart over ", span, " s give more than ", most,
                                  " segments, a hundred per pose; expected a longer interval");
  }
  return static_cast<std::size_t>(segments);
}

/// The knots that the options specify for these poses, and the number of control points. Poses that are after the last
/// of UniformKnots by rounding alone are moved onto it. Throws std::invalid_argument if the knots do not cover all
/// poses, or if UniformKnots or knot_interval give more than a hundred segments per pose.
template <typename Curve>
[[nodiscard]] std::pair<KnotsOf<Curve>, std::size_t> knots_over(PosesOf<Curve>& poses,
                                                                const FitOptions<Curve>& options) {
  using K = KnotsOf<Curve>;
  constexpr std::size_t k = Curve::order;
  const auto first = poses.front().time, last = poses.back().time;
  if (options.knot_interval) {
    const std::size_t segments = segment_count(to_seconds<double>(last - first), *options.knot_interval, poses.size());
    return {even_knots<K>(first, last, segments, Curve::order), segments + k - 1};
  }
  K knots = *options.knots;
  std::size_t control_points;
  if constexpr (requires { knots.interval; }) {
    knots.check(k, Curve::order);
    control_points = segment_count((std::max)(0.0, to_seconds<double>(time_between(knots.start, last))),
                                   to_seconds<double>(knots.interval), poses.size()) +
                     k - 1;
    knots.check(control_points, Curve::order);
    const auto end = knots.domain(control_points, Curve::order).end;
    for (auto pose = poses.rbegin(); pose != poses.rend() && pose->time > end; ++pose) pose->time = end;
  } else {
    if (knots.knots.size() < 2 * k) {
      refuse<std::invalid_argument>("fit: ", knots.knots.size(), " knots, expected at least ", 2 * k,
                                    ", twice the order of the curve");
    }
    control_points = knots.knots.size() - k;
    knots.check(control_points, Curve::order);
  }
  const auto domain = knots.domain(control_points, Curve::order);
  if (first < domain.start || poses.back().time > domain.end) {
    refuse<std::invalid_argument>("fit: poses from ", seconds_or_ticks(first), " to ", seconds_or_ticks(last),
                                  ", but the knots reach from ", seconds_or_ticks(domain.start), " to ",
                                  seconds_or_ticks(domain.end), "; expected knots that cover all poses");
  }
  return {std::move(knots), control_points};
}

/// The curve whose control points are the poses interpolated at the times of the control points. It smooths the poses
/// and does not pass through them. fit() starts here.
template <typename Curve>
[[nodiscard]] Curve poses_at_control_points(const PosesOf<Curve>& poses, KnotsOf<Curve> knots,
                                            std::size_t control_points) {
  std::vector<typename Curve::Group> points;
  points.reserve(control_points);
  std::size_t from = 0;
  for (std::size_t i = 0; i < control_points; ++i) {
    points.push_back(pose_between(poses, knots.control_point_time(i, Curve::order), from));
  }
  return Curve(std::move(knots), std::move(points));
}

}  // namespace splinertia::detail
