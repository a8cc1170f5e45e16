// SPDX-License-Identifier: MIT
/// What fit() is told and what it tells.
#pragma once

#include <cstddef>
#include <optional>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/spline/fit/knot_choice.hpp>
#include <splinertia/spline/fit/robust_loss.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace splinertia {

/// The type of a curve's knots.
template <typename Curve>
using KnotsOf = std::remove_cvref_t<decltype(std::declval<const Curve&>().knots())>;

/// Stamped poses as a curve takes them.
template <typename Curve>
using PosesOf = std::vector<Stamped<typename Curve::Group, typename Curve::Time>>;

/// How smooth a curve is believed to be, as a prior: its second (or third) derivative is white noise of this spectral
/// density. It adds ∫ |derivative/density|² dt to the squares of the residuals over their standard deviations, which is
/// what the likelihood of such noise costs. A larger density smooths less.
template <LieGroup G>
struct Smoothness {
  int derivative = 2;  ///< 2: acceleration, 3: jerk
  Tangent<G> density;  ///< of each component, > 0: m/s²/√Hz and rad/s²/√Hz, or m/s³/√Hz and rad/s³/√Hz
};

/// How fit() does its work. Without `knot_interval` and `knots` the interval is chosen from the rate, the noise and the
/// motion of the poses: choose_knot_interval().
template <typename Curve>
struct FitOptions {
  using Group = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  /// s: knots are spread evenly from the first to the last pose, at most so far apart.
  std::optional<double> knot_interval{};
  /// Knots of one's own. UniformKnots go on until the last pose, NonUniformKnots reach from before the first pose to
  /// behind the last.
  std::optional<KnotsOf<Curve>> knots{};
  /// Of a pose, in the tangent space at it: rad and m for SO3xR3. By default ones; with a robust loss, estimated from
  /// the residuals (median of their magnitudes), since what is an outlier depends on it.
  std::optional<Tangent<Group>> standard_deviation{};
  /// How much each pose counts, >= 0: its variance is that above over this. By default all are 1.
  std::vector<Scalar> weights{};
  RobustLoss loss = RobustLoss::squares();
  std::optional<Smoothness<Group>> smoothness{};
  /// A pose with a component further than so many standard deviations off is reported as an outlier.
  double outlier_limit = 6;
  int most_iterations = 100;
  /// Whether a weak prior holds the outermost Order − 2 segments at either end, where one wrong pose bends the curve as
  /// it likes: accelerations up to three times those of the rest, noise included, are believed. Without it, and without
  /// gaps, fit() is least squares (or the loss) and nothing else.
  bool hold_ends = true;
};

/// How far the curve is from the poses.
template <LieGroup G>
struct FitResiduals {
  using Scalar = ScalarOf<G>;

  std::vector<Tangent<G>> poses;  ///< log(pose⁻¹ · curve) of each pose
  Tangent<G> component_rms;       ///< of each component: rad and m for SO3xR3
  Tangent<G> component_max;       ///< largest magnitudes
  Scalar rms;                     ///< of |log(pose⁻¹ · curve)|, all components together whatever their units
  Scalar max;                     ///< of the same
};

/// A span without poses, long beside the knots and beside the usual interval of poses. The curve within is invented.
template <typename Time>
struct FitGap {
  Time start;  ///< of the last pose before the gap, or of the curve
  Time end;    ///< of the first pose behind it, or of the curve
};

template <typename Curve>
struct Fit {
  using Group = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  Curve spline;
  std::optional<KnotChoice<Group>> knot_choice{};  ///< where the options left the knots open
  FitResiduals<Group> residuals{};
  /// Of a pose: as given, or else as the residuals have it: 1.4826 times the median of their magnitudes, for the share
  /// of the data that the control points do not take.
  Tangent<Group> standard_deviation{};
  /// Poses that are further off than outlier_limit standard deviations. They still count as the loss has it, which is
  /// next to nothing with RobustLoss::cauchy().
  std::vector<std::size_t> outliers{};
  /// Where no poses are. There the curve takes the way of least acceleration from one side to the other (or what
  /// `smoothness` asks for), which nothing measured: a velocity or acceleration within a gap is not data.
  std::vector<FitGap<typename Curve::Time>> gaps{};
  /// How many control points the poses alone do not determine.
  std::size_t held_control_points = 0;
  int iterations = 0;      ///< linear systems solved
  bool converged = false;  ///< else most_iterations came first, or nothing lowered the cost any more
  Scalar condition{};      ///< of the normal equations scaled to ones on the diagonal, an estimate from below
};

}  // namespace splinertia
