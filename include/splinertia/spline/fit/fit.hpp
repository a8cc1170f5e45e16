// SPDX-License-Identifier: MIT
/// Fits a spline to stamped poses by least squares on the manifold.
#pragma once

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <splinertia/spline/fit/detail/fit_problem.hpp>
#include <splinertia/spline/fit/detail/pose_between.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/spline/spline.hpp>
#include <utility>

namespace splinertia {

/// The spline nearest to the poses:
///
///   using Curve = Spline<SO3xR3<double>, 4>;
///   auto fit = splinertia::fit<Curve>(poses, {.knot_interval = 0.05});
///   fit.spline;  fit.residuals.rms;  fit.outliers;  fit.gaps;
///
/// It minimises Σ loss(weight · |log(pose⁻¹ · curve)/standard_deviation|²) + smoothness over the control points by
/// damped Gauss–Newton steps on the group. It starts with the poses interpolated at the times of the control points. On
/// Rⁿ with squares one step is enough; a second confirms it. Memory and time are linear in the number of poses.
///
/// `poses` is any random-access range of Stamped. Their group is that of the curve, or SO3xR3 for SE3 and vice versa.
/// Their time is that of the curve, or nanoseconds for seconds and vice versa. The sign of a quaternion does not
/// matter.
///
/// Throws std::invalid_argument for fewer than two poses, for poses that are not finite, not on their group, or not in
/// ascending order of time, and for invalid options. Fit::gaps and Fit::regularized_control_points show where poses are too
/// few.
template <typename Curve, detail::StampedPoses Poses>
  requires LieGroupWithJacobians<typename Curve::Group>
[[nodiscard]] Fit<Curve> fit(const Poses& poses, const FitOptions<Curve>& options = {}) {
  const auto fit_once = [&](const FitOptions<Curve>& with) {
    detail::FitProblem<Curve> problem(poses, with);
    problem.solve();
    Curve curve = problem.curve();
    return std::move(problem).report(std::move(curve));
  };
  Fit<Curve> result = fit_once(options);
  if (!result.knot_choice) return result;
  // The interval is chosen before the curve is known. If the curve then turns too far from one control point to the
  // next, or has more outliers than chance explains, shorter intervals are tried.
  const auto turns_too_far = [](const Fit<Curve>& fit) {
    const auto& increments = fit.spline.increments();
    return std::any_of(increments.begin(), increments.end(), [](const auto& d) {
      return static_cast<double>(detail::TurnAngle<typename Curve::Group>::of(d)) > detail::largest_turn;
    });
  };
  const auto outliers = [](const Fit<Curve>& fit) { return fit.outliers.size(); };
  const std::size_t few = std::ranges::size(poses) / 50;
  for (int tries = 0; tries < 4; ++tries) {
    // An outlier may also turn control points too far, although no pose turns that fast.
    const bool fast = 2 * result.knot_choice->interval > result.knot_choice->unambiguous;
    const bool turns = fast && turns_too_far(result);
    if (!turns && (outliers(result) <= few || result.knot_choice->limit == KnotLimit::poses)) break;
    FitOptions<Curve> closer = options;
    detail::KnotChoice<typename Curve::Group> choice = *result.knot_choice;
    choice.interval *= 0.7;
    choice.limit = turns ? KnotLimit::turn : KnotLimit::motion;
    closer.knot_interval = choice.interval;
    Fit<Curve> next = fit_once(closer);
    if (turns ? !turns_too_far(next) || next.converged : next.converged && 2 * outliers(next) < outliers(result)) {
      next.knot_choice = choice;
      result = std::move(next);
    } else {
      break;
    }
  }
  return result;
}

}  // namespace splinertia
