// SPDX-License-Identifier: MIT
/// Least squares on the manifold: the spline that lies nearest to stamped poses.
#pragma once

#include <splinertia/spline/fit_data.hpp>
#include <splinertia/spline/fit_options.hpp>
#include <splinertia/spline/fit_problem.hpp>
#include <splinertia/spline/spline.hpp>
#include <utility>

namespace splinertia {

/// The spline nearest to the poses:
///
///   using Curve = Spline<SO3xR3<double>, 4>;
///   auto fit = splinertia::fit<Curve>(poses, {.knot_interval = 0.05});
///   fit.spline;  fit.residuals.rms;  fit.outliers;  fit.gaps;
///
/// It minimises Σ loss(weight · |log(pose⁻¹ · curve)/standard_deviation|²) + smoothness over the control points, from
/// the poses at their times on, by damped Gauss–Newton steps on the group. Rⁿ with squares takes one; a second shows
/// that. Memory and time are linear in the number of poses.
///
/// `poses` is any range of Stamped: of the curve's group, or of SO3xR3 for SE3 and the other way round; of its time, or
/// nanoseconds for seconds and the other way round. The sign of a quaternion does not matter.
///
/// Throws std::invalid_argument for fewer than two poses, poses that are not finite, not on their group, or not in
/// ascending order of time; options that make no sense; and fewer poses than control points without smoothness. Where
/// there are enough, but not everywhere, Fit::gaps says where and what was done.
template <typename Curve, StampedPoses Poses>
  requires LieGroupWithJacobians<typename Curve::Group>
[[nodiscard]] Fit<Curve> fit(const Poses& poses, const FitOptions<Curve>& options) {
  FitProblem<Curve> problem(poses, options);
  problem.solve();
  Curve curve = problem.curve();
  return std::move(problem).report(std::move(curve));
}

}  // namespace splinertia
