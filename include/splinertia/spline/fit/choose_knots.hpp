// SPDX-License-Identifier: MIT
/// Chooses a knot interval: the longest that meets a goal for the residuals, or the best by cross-validation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia {

namespace detail {

/// Throws std::invalid_argument, naming the caller, `whose`, unless every component is finite and positive.
template <LieGroup G>
void check_goal(const char* whose, const Tangent<G>& goal) {
  for (int i = 0; i < goal.size(); ++i) {
    if (is_finite(goal[i]) && goal[i] > ScalarOf<G>(0)) continue;
    refuse<std::invalid_argument>(whose, ": component ", i, " of the goal is ", goal[i],
                                  ", expected a finite number > 0");
  }
}

/// The options for the many fits of a search. Most of these fits have knots too far apart. They do not show which poses
/// are outliers, and iterations do not improve them: each gets at most 10. So with a robust loss a single fit, with a
/// segment for every four poses, finds the outliers: they deviate by more than outlier_limit times the goal (or the
/// standard deviation, if there is no goal). They get weight 0, and all further fits are least squares. If half of the
/// poses or more exceed the limit, they are not outliers: the fit has missed its goal, and all keep their weight.
template <typename Curve>
[[nodiscard]] FitOptions<Curve> search_options(FitOptions<Curve> options, const PosesOf<Curve>& data,
                                               const std::optional<Tangent<typename Curve::Group>>& goal) {
  using Scalar = typename Curve::Scalar;
  if (!options.knots && !options.knot_interval) options.knot_interval = 1;
  check(options, data.size());
  const std::size_t segments = (data.size() + 3) / 4;
  if (!options.loss.is_squares() && segments + Curve::order - 1 <= data.size()) {
    FitOptions<Curve> finest = options;
    finest.knots.reset();
    finest.knot_interval = to_seconds<double>(data.back().time - data.front().time) / static_cast<double>(segments);
    if (goal) finest.standard_deviation = goal;
    const auto outliers = fit<Curve>(data, finest).outliers;
    if (options.weights.empty()) options.weights.assign(data.size(), Scalar(1));
    if (outliers.size() < data.size() / 2) {
      for (const std::size_t i : outliers) options.weights[i] = Scalar(0);
    }
  }
  options.loss = RobustLoss::squares();
  options.most_iterations = (std::min)(options.most_iterations, 10);
  return options;
}

}  // namespace detail

/// The longest knot interval, to a twentieth, for which fit() brings the RMS of every component of the residuals down
/// to `goal` (rad and m for SO3xR3). With a robust loss, outliers are excluded (search_options). The search halves the
/// interval, from one segment per thousand poses on, until the goal is met. Then it bisects between the last two.
///
/// Throws std::runtime_error if no interval that gives at most as many control points as poses meets the goal, and
/// std::invalid_argument for a goal that is not finite and positive, or as fit() does.
template <typename Curve, detail::StampedPoses Poses>
[[nodiscard]] double coarsest_knot_interval(const Poses& poses, const Tangent<typename Curve::Group>& goal,
                                            FitOptions<Curve> options = {}) {
  detail::check_goal<typename Curve::Group>("coarsest_knot_interval", goal);
  const auto data = convert_poses<Curve>(poses, "coarsest_knot_interval");
  options = detail::search_options<Curve>(std::move(options), data, goal);
  options.knots.reset();
  const double span = to_seconds<double>(data.back().time - data.front().time);
  Tangent<typename Curve::Group> reached;
  const auto interval_of = [&](std::size_t segments) { return span / static_cast<double>(segments); };
  const auto good = [&](std::size_t segments) {
    options.knot_interval = interval_of(segments);
    reached = fit<Curve>(data, options).residuals.component_rms;
    return (reached.array() <= goal.array()).all();
  };
  // With fewer poses than control points of one segment, only one segment is tried.
  const std::size_t most = data.size() < Curve::order ? 1 : data.size() - Curve::order + 1;
  std::size_t too_few = 0, enough = std::max<std::size_t>(1, data.size() / 1000);
  while (enough <= most && !good(enough)) {
    too_few = enough;
    enough = enough < most ? (std::min)(2 * enough, most) : most + 1;
  }
  if (enough > most) {
    detail::refuse<std::runtime_error>("coarsest_knot_interval: even with knots ", interval_of(most),
                                       " s apart, one control point per pose, the RMS residuals are up to ",
                                       reached.cwiseQuotient(goal).maxCoeff(), " times the goal");
  }
  while (enough - too_few > std::max<std::size_t>(1, enough / 20)) {
    const std::size_t middle = too_few + (enough - too_few) / 2;
    (good(middle) ? enough : too_few) = middle;
  }
  return interval_of(enough);
}

/// The error of one knot interval in cross-validation.
struct KnotIntervalError {
  double knot_interval;  ///< s
  double error;          ///< of the poses left out: geometric mean of the RMS of the components
};
/// The result of cross_validated_knot_interval().
struct CrossValidation {
  double knot_interval;  ///< s: the longest whose error is within the tolerance of the least
  std::vector<KnotIntervalError> tried;
};

namespace detail {

/// The error of fits at poses that they leave out: the geometric mean over the components of the RMS residual, each
/// mean square at least `least_square`. One fit leaves out every fourth pose, another the poses halfway between those.
/// Poses of weight zero do not count.
template <typename Curve>
[[nodiscard]] double left_out_error(const PosesOf<Curve>& data, const FitOptions<Curve>& options,
                                    const typename Curve::Scalar& least_square) {
  using Scalar = typename Curve::Scalar;
  using Square = Tangent<typename Curve::Group>;
  constexpr std::size_t every = 4;
  Square squares = Square::Zero();
  std::size_t count = 0;
  for (const std::size_t first : {std::size_t(1), std::size_t(3)}) {
    FitOptions<Curve> without = options;
    // The ends are never left out, because the curve would have to be extrapolated there.
    for (std::size_t i = first; i + 1 < data.size(); i += every) without.weights[i] = Scalar(0);
    const Fit<Curve> result = fit<Curve>(data, without);
    for (std::size_t i = first; i + 1 < data.size(); i += every) {
      if (options.weights[i] == Scalar(0)) continue;
      squares += result.residuals.poses[i].cwiseAbs2();
      ++count;
    }
  }
  squares /= static_cast<Scalar>(std::max<std::size_t>(count, 1));
  return std::exp(static_cast<double>((squares.array().max)(least_square).log().mean()) / 2);
}

}  // namespace detail

/// The knot interval that best predicts poses that are left out of the fit. Each interval is fitted twice: without
/// every fourth pose, and without the poses halfway between those. The intervals decrease by the root of two, from one
/// segment per 512 poses on, until the error exceeds the least by more than `tolerance` (relative) twice in a row. The
/// result is the longest interval whose error is within `tolerance` of the least.
///
/// Requires independent noise of neighbouring poses: for a trajectory that an estimator has smoothed, the finest
/// interval is always the best. Throws as fit() does.
template <typename Curve, detail::StampedPoses Poses>
[[nodiscard]] CrossValidation cross_validated_knot_interval(const Poses& poses, FitOptions<Curve> options = {},
                                                            double tolerance = 0.02) {
  using Scalar = typename Curve::Scalar;
  const auto data = convert_poses<Curve>(poses, "cross_validated_knot_interval");
  options = detail::search_options<Curve>(std::move(options), data, {});
  options.knots.reset();
  if (options.weights.empty()) options.weights.assign(data.size(), Scalar(1));
  const double span = to_seconds<double>(data.back().time - data.front().time);

  // A component that never moves has only rounding errors, which say nothing about an interval.
  Scalar size(1);
  for (const auto& pose : data) {
    size = (std::max)(size, Scalar(GroupTraits<typename Curve::Group>::log(pose.value).cwiseAbs().maxCoeff()));
  }
  const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * size, least_square = rounding * rounding;

  CrossValidation result{span, {}};
  double least = std::numeric_limits<double>::infinity();
  int increases = 0;
  const double most = 0.6 * static_cast<double>(data.size()) - Curve::order;
  for (double segments = (std::max)(1.0, static_cast<double>(data.size()) / 512); segments <= (std::max)(1.0, most);
       segments *= std::sqrt(2.0)) {
    const double interval = span / std::round(segments);
    if (!result.tried.empty() && interval == result.tried.back().knot_interval) continue;
    options.knot_interval = interval;
    result.tried.push_back({interval, detail::left_out_error<Curve>(data, options, least_square)});
    increases = result.tried.back().error > least * (1 + tolerance) ? increases + 1 : 0;
    least = (std::min)(least, result.tried.back().error);
    if (increases == 2) break;
  }
  for (const auto& [interval, error] : result.tried) {
    if (error <= least * (1 + tolerance)) {
      result.knot_interval = interval;
      break;
    }
  }
  return result;
}

}  // namespace splinertia
