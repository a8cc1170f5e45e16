// SPDX-License-Identifier: MIT
/// Interpolates poses: the spline that passes through every pose.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/spline/fit/convert_poses.hpp>
#include <splinertia/spline/fit/curve_ends.hpp>
#include <splinertia/spline/fit/detail/curve_model.hpp>
#include <splinertia/spline/fit/detail/fit_residuals.hpp>
#include <splinertia/spline/fit/detail/knots_over.hpp>
#include <splinertia/spline/fit/detail/least_squares.hpp>
#include <splinertia/spline/fit/detail/pose_term.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/spline/spline.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia {

namespace detail {

/// Knots for a curve through the poses, and the number of control points. NonUniformKnots are at the poses, except
/// those that not-a-knot leaves out. UniformKnots are evenly spaced; throws std::invalid_argument if a pose is more
/// than a quarter of their interval from its knot.
template <typename Curve>
[[nodiscard]] std::pair<KnotsOf<Curve>, std::size_t> interpolation_knots(const PosesOf<Curve>& poses,
                                                                         EndCondition ends) {
  using K = KnotsOf<Curve>;
  constexpr std::size_t k = Curve::order;
  const std::size_t n = poses.size();
  if constexpr (requires(const K& knots) { knots.interval; }) {
    K knots = even_knots<K>(poses.front().time, poses.back().time, n - 1, Curve::order);
    for (std::size_t i = 0; i < n; ++i) {
      const double off = to_seconds<double>(time_between(knots.knot(i, Curve::order), poses[i].time));
      if (!(std::abs(off) <= 0.25 * to_seconds<double>(knots.interval))) {
        refuse<std::invalid_argument>("interpolate: pose ", i, " is ", off, " s from its knot (knots every ",
                                      to_seconds<double>(knots.interval),
                                      " s), expected evenly spaced poses for UniformKnots; "
                                      "use NonUniformKnots");
      }
    }
    return {knots, n + k - 2};
  } else {
    const std::size_t left_out = ends == EndCondition::not_a_knot ? k / 2 - 1 : 0;
    std::vector<typename Curve::Time> knots(k, poses.front().time);
    for (std::size_t i = 1 + left_out; i + 1 + left_out < n; ++i) knots.push_back(poses[i].time);
    knots.insert(knots.end(), k, poses.back().time);
    const std::size_t control_points = knots.size() - k;
    return {K{std::move(knots)}, control_points};
  }
}

}  // namespace detail

/// The spline of an even order >= 4 through every pose, Order − 2 times continuously differentiable:
///
///   using Curve = Spline<SO3xR3<double>, 4, NonUniformKnots<double>>;
///   const Curve curve = interpolate<Curve>(poses);
///   const Curve clamped = interpolate<Curve>(poses, {.condition = EndCondition::clamped});   // begins, ends at rest
///
/// It reproduces the noise of the poses. Use fit() for measured poses: accelerations would be mostly noise. `poses` is
/// any range of Stamped, as for fit().
///
/// Throws std::invalid_argument for invalid poses as fit() does, for fewer than two poses (with not-a-knot: than the
/// order), and for unevenly spaced poses with UniformKnots. Throws std::runtime_error if no such curve is found because
/// the poses turn too much from one to the next.
template <typename Curve, detail::StampedPoses Poses>
  requires LieGroupWithJacobians<typename Curve::Group>
[[nodiscard]] Curve interpolate(const Poses& poses, const CurveEnds<typename Curve::Group>& ends = {}) {
  static_assert(Curve::order >= 4 && Curve::order % 2 == 0, "interpolate() needs a curve of even order, at least 4");
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  const auto data = convert_poses<Curve>(poses, "interpolate");
  const std::size_t least = ends.condition == EndCondition::not_a_knot ? Curve::order : 2;
  if (data.size() < least) {
    detail::refuse<std::invalid_argument>("interpolate: ", data.size(), " poses, expected at least ", least);
  }
  auto [knots, control_points] = detail::interpolation_knots<Curve>(data, ends.condition);
  Curve curve = detail::poses_at_control_points<Curve>(data, std::move(knots), control_points);

  // There are as many equations as unknowns, so the minimum of the squares is zero.
  using Model = detail::CurveModel<Curve, Curve::order, detail::PoseTerm<Curve>, detail::EndTerm<Curve>>;
  const std::vector<Scalar> weights;
  const detail::PoseTerm<Curve> through(data, weights, Tangent<G>::Ones(), RobustLoss::squares());
  const detail::EndTerm<Curve> end_term(ends, curve);
  typename Model::System system(control_points);
  detail::BandedCholesky<typename Model::System> factor;
  const Scalar extent = detail::extent_of(data).maxCoeff(), epsilon = std::numeric_limits<Scalar>::epsilon();
  const auto minimum =
      detail::minimize(Model(through, end_term), curve, system, factor,
                       {.relative = Scalar(0), .absolute = epsilon * extent * extent, .most_iterations = 100});
  const auto all = [](std::size_t) { return true; };
  const Scalar off = detail::residuals_of(data, curve, all).max;
  using std::sqrt;
  if (!minimum.converged || !(off <= sqrt(epsilon) * (Scalar(1) + extent) / Scalar(64))) {
    detail::refuse<std::runtime_error>("interpolate: no curve found through all poses, the best is off by up to ", off);
  }
  return curve;
}

}  // namespace splinertia
