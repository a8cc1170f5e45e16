// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <splinertia/spline/fit/convert_poses.hpp>
#include <splinertia/spline/fit/detail/banded_system.hpp>
#include <splinertia/spline/fit/detail/curve_model.hpp>
#include <splinertia/spline/fit/detail/data_support.hpp>
#include <splinertia/spline/fit/detail/end_jumps.hpp>
#include <splinertia/spline/fit/detail/fit_residuals.hpp>
#include <splinertia/spline/fit/detail/gap_regularization.hpp>
#include <splinertia/spline/fit/detail/knots_over.hpp>
#include <splinertia/spline/fit/detail/least_squares.hpp>
#include <splinertia/spline/fit/detail/pose_term.hpp>
#include <splinertia/spline/fit/detail/smoothness.hpp>
#include <splinertia/spline/fit/detail/unmeasured_spans.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/spline/fit/pose_statistics.hpp>
#include <splinertia/spline/spline.hpp>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// The steps of fit(). A problem that adds other measurements of the same curve continues from here.
template <typename Curve>
  requires LieGroupWithJacobians<typename Curve::Group>
class FitProblem {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  /// Checks poses and options, chooses knots, and makes the first curve from the poses. Throws std::invalid_argument as
  /// fit() does.
  template <StampedPoses Poses>
  FitProblem(const Poses& poses, FitOptions<Curve> options)
      : options_(std::move(options)), data_(convert_poses<Curve>(poses, "fit")), fit_{first_curve()} {
    if (!options_.loss.is_squares()) leave_out_wrong_ends();
    const std::size_t control_points = fit_.spline.control_points().size();
    const auto undetermined = undetermined_control_points<Curve>(fit_.spline.knots(), control_points, data_, counts());
    fit_.knot_choice = choice_;
    fit_.regularized_control_points = undetermined.size();
    const auto thin = thinly_measured_control_points<Curve>(fit_.spline.knots(), control_points, data_, counts());
    std::vector<std::size_t> weak;
    std::set_union(undetermined.begin(), undetermined.end(), thin.begin(), thin.end(), std::back_inserter(weak));
    spans_ = unmeasured_spans(fit_.spline, data_, counts(), weak);
    fit_.gaps = reported_gaps(fit_.spline, data_, counts(), spans_);
    extent_ = extent_of(data_);
    std::size_t counted = 0;
    for (std::size_t i = 0; i < data_.size(); ++i) counted += counts()(i) ? 1 : 0;
    taken_share_ = Scalar(control_points - undetermined.size()) / Scalar(std::max<std::size_t>(counted, 1));
    free_share_ = Scalar(1) - (std::min)(taken_share_, Scalar(3) / Scalar(4));
    taken_share_ = (std::min)(taken_share_, Scalar(1));
  }

  /// Finds the spline nearest to the poses. If a robust loss has no given standard deviation, this takes several
  /// rounds: the deviation decides which poses are outliers, and is estimated from the others.
  void solve() {
    constexpr Scalar rough = Scalar(1) / Scalar(1000), epsilon = std::numeric_limits<Scalar>::epsilon();
    System system(fit_.spline.control_points().size());
    BandedCholesky<System> factor;
    const auto minimize_with = [&](const RobustLoss& loss, const Scalar& relative, int most_iterations) {
      const Scalar whitened_extent = extent_.cwiseQuotient(fit_.standard_deviation).maxCoeff();
      const PoseTerm<Curve> poses = pose_term(loss);
      const SmoothnessTerms<Curve> smoothness = smoothness_terms();
      system.clear();
      const auto minimum =
          minimize(Model(poses, smoothness), fit_.spline, system, factor,
                   {.relative = (std::max)(relative, 16 * epsilon),
                    .absolute = epsilon * whitened_extent * whitened_extent,
                    .most_iterations = (std::min)(most_iterations, options_.most_iterations - fit_.iterations)});
      fit_.iterations += minimum.iterations;
      fit_.converged = minimum.converged;
    };
    const bool squares = options_.loss.is_squares();
    fit_.standard_deviation = options_.standard_deviation.value_or(Tangent<G>::Ones());
    noise_ = options_.standard_deviation.value_or(deviation_of_residuals());
    if (!options_.standard_deviation && !(squares && priorless())) {
      // One or two least-squares steps give the noise to a factor of two, which is enough for the prior.
      const int steps = squares ? 1 : 5;
      minimize_with(RobustLoss::squares(), rough, steps);
      for (int round = 0; round < 10; ++round) {
        const Tangent<G> before = noise_;
        noise_ = deviation_of_residuals();
        if (!squares) fit_.standard_deviation = noise_;
        if (squares ? (noise_.array() > before.array() / 2).all()
                    : round > 0 && noise_.isApprox(before, Scalar(1) / Scalar(100))) {
          break;
        }
        minimize_with(options_.loss, rough, steps);
      }
    } else if (!priorless()) {
      minimize_with(options_.loss, rough, squares ? 1 : 5);
    }
    // Least squares converge quadratically or nearly so. Reweighted squares converge linearly, and what remains below
    // this tolerance is negligible.
    minimize_with(options_.loss, options_.loss.is_squares() ? Scalar(1e-12f) : Scalar(1e-6f), options_.most_iterations);
    // Once more without damping: the last step may have been damped, or there was none.
    fit_.condition = factor.compute(system, Scalar(0)) ? condition_estimate(system, factor)
                                                       : std::numeric_limits<Scalar>::infinity();
    if (!options_.standard_deviation) fit_.standard_deviation = deviation_of_residuals();
  }

  [[nodiscard]] const Curve& curve() const { return fit_.spline; }
  [[nodiscard]] const std::vector<FitGap<typename Curve::Time>>& gaps() const { return fit_.gaps; }
  /// The cost of the poses. Refers to members of this object.
  [[nodiscard]] PoseTerm<Curve> pose_term(const RobustLoss& loss) const& {
    return {data_, options_.weights, fit_.standard_deviation, loss};
  }
  PoseTerm<Curve> pose_term(const RobustLoss& loss) && = delete;
  /// The prior where neither the poses nor other measurements, at the ascending times `others`, determine the curve,
  /// estimated from the present curve. If the options give `smoothness`, that prior over the whole curve.
  [[nodiscard]] SmoothnessTerms<Curve> smoothness_terms(const std::vector<typename Curve::Time>& others = {}) const {
    const Curve& curve = fit_.spline;
    if (options_.smoothness) {
      const auto& [derivative, density] = *options_.smoothness;
      return {{SmoothnessTerm<Curve>(derivative, density, curve.start(), curve.end())}};
    }
    return GapRegularization<Curve>(curve, spans_, noise_, fit_.standard_deviation, taken_share_, others)
        .terms(options_.regularize_ends);
  }

  /// The result of fit() for `curve`, which solve() or a later optimisation has found.
  [[nodiscard]] Fit<Curve> report(Curve curve) && {
    fit_.spline = std::move(curve);
    fit_.residuals = residuals_of(data_, fit_.spline, counts());
    for (std::size_t i = 0; i < data_.size(); ++i) {
      const Scalar off = fit_.residuals.poses[i].cwiseQuotient(fit_.standard_deviation).cwiseAbs().maxCoeff();
      if (off > Scalar(options_.outlier_limit)) fit_.outliers.push_back(i);
    }
    return std::move(fit_);
  }

 private:
  using Model = CurveModel<Curve, Curve::order - 1, PoseTerm<Curve>, SmoothnessTerms<Curve>>;
  using System = typename Model::System;

  /// Gives weight 0 to the poses beyond a jump at either end, which no loss can distinguish from motion.
  void leave_out_wrong_ends() {
    const auto [first, last] = poses_between_jumps(data_);
    if (first == 0 && last + 1 == data_.size()) return;
    if (options_.weights.empty()) options_.weights.assign(data_.size(), Scalar(1));
    std::fill_n(options_.weights.begin(), first, Scalar(0));
    std::fill(options_.weights.begin() + static_cast<std::ptrdiff_t>(last) + 1, options_.weights.end(), Scalar(0));
  }

  /// Whether no prior is to be estimated: there is none, or `smoothness` is given.
  [[nodiscard]] bool priorless() const { return options_.smoothness || (spans_.empty() && !options_.regularize_ends); }

  [[nodiscard]] auto counts() const {
    return [this](std::size_t i) { return options_.weights.empty() || options_.weights[i] > Scalar(0); };
  }

  [[nodiscard]] Curve first_curve() {
    check(options_, data_.size());
    if (!options_.knots && !options_.knot_interval) {
      choice_ = choose_knot_interval(data_, Curve::order);
      options_.knot_interval = choice_->interval;
    }
    auto [knots, control_points] = knots_over<Curve>(data_, options_);
    return poses_at_control_points<Curve>(data_, std::move(knots), control_points);
  }

  [[nodiscard]] Tangent<G> deviation_of_residuals() const {
    using std::sqrt;
    constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    // A lower bound, from rounding. If a prior determines control points, its weight is at least √eps.
    const Scalar share = spans_.empty() ? 64 * epsilon : sqrt(epsilon);
    const Scalar extent = extent_.maxCoeff();
    const Tangent<G> found = robust_deviation<Curve>(data_, fit_.spline, counts(), free_share_,
                                                     share * (extent > Scalar(0) ? extent : Scalar(1)));
    // With nearly as many control points as poses, the residuals are almost zero.
    if (taken_share_ < Scalar(3) / Scalar(4) || data_.size() < 3) return found;
    return found.cwiseMax(pose_noise(data_));
  }

  FitOptions<Curve> options_;
  PosesOf<Curve> data_;
  std::optional<KnotChoice<G>> choice_;
  Fit<Curve> fit_;
  std::vector<UnmeasuredSpan<typename Curve::Time>> spans_;
  Tangent<G> noise_;    // standard deviation of a pose, given or from the residuals
  Tangent<G> extent_;   // of the poses
  Scalar taken_share_;  // share of the data that the control points take
  Scalar free_share_;   // share that they leave free, at least a quarter
};

}  // namespace splinertia::detail
