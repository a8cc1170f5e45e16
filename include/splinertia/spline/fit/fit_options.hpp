// SPDX-License-Identifier: MIT
/// The options and the result of fit().
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

namespace detail {

/// The type of a curve's knots.
template <typename Curve>
using KnotsOf = std::remove_cvref_t<decltype(std::declval<const Curve&>().knots())>;

}  // namespace detail

/// Stamped poses in the group and the time type of a curve.
template <typename Curve>
using PosesOf = std::vector<Stamped<typename Curve::Group, typename Curve::Time>>;

/// A prior on the smoothness of a curve: its second (or third) derivative is white noise of this spectral density. The
/// prior adds ∫ |derivative/density|² dt, minus twice the log-likelihood of such noise up to a constant, to the squares
/// of the residuals over their standard deviations. A larger density smooths less.
template <LieGroup G>
struct Smoothness {
  int derivative = 2;  ///< 2: acceleration, 3: jerk
  Tangent<G> density;  ///< of each component, > 0: m/s²/√Hz and rad/s²/√Hz, or m/s³/√Hz and rad/s³/√Hz
};

/// The options of fit(). Without `knot_interval` and `knots`, choose_knot_interval() chooses the interval from the
/// rate, the noise and the motion of the poses.
template <typename Curve>
struct FitOptions {
  using Group = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  /// The largest knot interval, s. Knots are evenly spaced from the first to the last pose.
  std::optional<double> knot_interval{};
  /// Your own knots. UniformKnots are continued to the last pose; NonUniformKnots must cover all poses.
  std::optional<detail::KnotsOf<Curve>> knots{};
  /// Standard deviation of a pose, per tangent component: rad and m for SO3xR3. By default ones. With a robust loss it
  /// is by default estimated from the residuals (median of their magnitudes), because it decides which poses are
  /// outliers.
  std::optional<Tangent<Group>> standard_deviation{};
  /// Weight of each pose, >= 0: its variance is standard_deviation² / weight. By default all are 1.
  std::vector<Scalar> weights{};
  RobustLoss loss = RobustLoss::squares();
  std::optional<Smoothness<Group>> smoothness{};
  /// A pose is reported as an outlier if a component deviates by more than this many standard deviations.
  double outlier_limit = 6;
  int most_iterations = 100;
  /// Whether a weak prior regularises the outermost Order − 2 segments at either end, where one wrong pose bends the
  /// curve freely. It allows accelerations up to three times those of the rest, noise included. Without it and
  /// without gaps, fit() is pure least squares (or the loss).
  bool regularize_ends = true;
};

namespace detail {

/// The residuals of the curve at the poses.
template <LieGroup G>
struct FitResiduals {
  using Scalar = ScalarOf<G>;

  std::vector<Tangent<G>> poses;  ///< log(pose⁻¹ · curve) of each pose
  Tangent<G> component_rms;       ///< RMS of each component: rad and m for SO3xR3
  Tangent<G> component_max;       ///< largest magnitude of each component
  Scalar rms;                     ///< RMS of |log(pose⁻¹ · curve)|, over all components regardless of their units
  Scalar max;                     ///< largest |log(pose⁻¹ · curve)|
};

}  // namespace detail

/// A span without poses, long compared with the knot interval and with the usual interval of poses. No data determine
/// the curve inside it. Stretches of at most Order poses between such spans belong to it: so few poses do not determine an
/// acceleration.
template <typename Time>
struct FitGap {
  Time start;  ///< time of the last pose before the gap, or start of the curve
  Time end;    ///< time of the first pose after it, or end of the curve
};

template <typename Curve>
struct Fit {
  using Group = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  Curve spline;
  std::optional<detail::KnotChoice<Group>> knot_choice{};  ///< set if the options specify no knots
  detail::FitResiduals<Group> residuals{};
  /// Standard deviation of a pose: as given, or estimated from the residuals (1.4826 times the median of their
  /// magnitudes, corrected for the share of the data that the control points take).
  Tangent<Group> standard_deviation{};
  /// Indices of the poses that deviate by more than outlier_limit standard deviations. The loss decides how much they
  /// still count, with RobustLoss::cauchy() hardly at all.
  std::vector<std::size_t> outliers{};
  /// Spans with no or hardly any poses. There the curve takes the path of least acceleration from one side to the other (or what
  /// `smoothness` asks for). No measurement supports it: a velocity or acceleration within a gap is not data.
  std::vector<FitGap<typename Curve::Time>> gaps{};
  /// Number of control points that the poses alone do not determine.
  std::size_t regularized_control_points = 0;
  int iterations = 0;      ///< linear systems solved
  bool converged = false;  ///< false: most_iterations was reached, or no step lowered the cost
  Scalar condition{};      ///< condition number of the normal equations scaled to unit diagonal; estimated from below
};

}  // namespace splinertia
