// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <splinertia/spline/fit/detail/banded_system.hpp>
#include <splinertia/spline/fit/detail/curve_model.hpp>
#include <splinertia/spline/fit/detail/data_support.hpp>
#include <splinertia/spline/fit/detail/end_jumps.hpp>
#include <splinertia/spline/fit/detail/fit_data.hpp>
#include <splinertia/spline/fit/detail/fit_residuals.hpp>
#include <splinertia/spline/fit/detail/gap_bridges.hpp>
#include <splinertia/spline/fit/detail/knots_over.hpp>
#include <splinertia/spline/fit/detail/least_squares.hpp>
#include <splinertia/spline/fit/detail/pose_statistics.hpp>
#include <splinertia/spline/fit/detail/pose_term.hpp>
#include <splinertia/spline/fit/detail/smoothness.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/spline/fit/unmeasured_spans.hpp>
#include <splinertia/spline/spline.hpp>
#include <utility>
#include <vector>

namespace splinertia {

/// What fit() does, step by step. A problem that holds the same curve by other data as well goes on from here.
template <typename Curve>
  requires LieGroupWithJacobians<typename Curve::Group>
class FitProblem {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  /// Checks everything, chooses knots, and starts from the poses at their times. Throws std::invalid_argument as fit()
  /// says.
  template <StampedPoses Poses>
  FitProblem(const Poses& poses, FitOptions<Curve> options)
      : options_(std::move(options)), data_(fit_data<Curve>(poses, "fit")), fit_{first_curve()} {
    if (!options_.loss.is_squares()) leave_out_wrong_ends();
    const std::size_t control_points = fit_.spline.control_points().size();
    const auto undetermined = undetermined_control_points<Curve>(fit_.spline.knots(), control_points, data_, counts());
    fit_.knot_choice = choice_;
    fit_.held_control_points = undetermined.size();
    const auto thin = thinly_measured_control_points<Curve>(fit_.spline.knots(), control_points, data_, counts());
    std::vector<std::size_t> weak;
    std::set_union(undetermined.begin(), undetermined.end(), thin.begin(), thin.end(), std::back_inserter(weak));
    spans_ = unmeasured_spans(fit_.spline, data_, counts(), weak);
    for (const auto& span : spans_) {
      if (span.is_gap) fit_.gaps.push_back({span.start, span.end});
    }
    extent_ = extent_of(data_);
    std::size_t counted = 0;
    for (std::size_t i = 0; i < data_.size(); ++i) counted += counts()(i) ? 1 : 0;
    taken_share_ = Scalar(control_points - undetermined.size()) / Scalar(std::max<std::size_t>(counted, 1));
    free_share_ = Scalar(1) - (std::min)(taken_share_, Scalar(3) / Scalar(4));
    taken_share_ = (std::min)(taken_share_, Scalar(1));
  }

  /// The spline nearest to the poses: of a robust loss without a given deviation in rounds, since what is an outlier
  /// depends on the deviation, and this on what is not.
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
      // A step or two of squares show the noise to a factor of two, which is what the prior asks for.
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
    // Squares converge quadratically or nearly; weights that are found anew in each step do so linearly, and what is
    // left of them moves nothing.
    minimize_with(options_.loss, options_.loss.is_squares() ? Scalar(1e-12f) : Scalar(1e-6f), options_.most_iterations);
    // The last step may have been damped, or there was none.
    fit_.condition = factor.compute(system, Scalar(0)) ? condition_estimate(system, factor)
                                                       : std::numeric_limits<Scalar>::infinity();
    if (!options_.standard_deviation) fit_.standard_deviation = deviation_of_residuals();
  }

  [[nodiscard]] const Curve& curve() const { return fit_.spline; }
  [[nodiscard]] const std::vector<FitGap<typename Curve::Time>>& gaps() const { return fit_.gaps; }
  /// Refers to the poses that are kept here.
  [[nodiscard]] PoseTerm<Curve> pose_term(const RobustLoss& loss) const& {
    return {data_, options_.weights, fit_.standard_deviation, loss};
  }
  PoseTerm<Curve> pose_term(const RobustLoss& loss) && = delete;
  /// What holds the curve where neither the poses do nor other measurements, at the ascending times `others`; as the
  /// present curve says.
  [[nodiscard]] SmoothnessTerms<Curve> smoothness_terms(const std::vector<typename Curve::Time>& others = {}) const {
    const Curve& curve = fit_.spline;
    if (options_.smoothness) {
      const auto& [derivative, density] = *options_.smoothness;
      return {{SmoothnessTerm<Curve>(derivative, density, curve.start(), curve.end())}};
    }
    return GapBridges<Curve>(curve, spans_, noise_, fit_.standard_deviation, taken_share_, others)
        .terms(options_.hold_ends);
  }

  /// The report on `curve`, whether solve() has found it or another did from there on.
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

  /// The poses beyond a jump at either end, which no loss can tell from a motion.
  void leave_out_wrong_ends() {
    const auto [first, last] = poses_between_jumps(data_);
    if (first == 0 && last + 1 == data_.size()) return;
    if (options_.weights.empty()) options_.weights.assign(data_.size(), Scalar(1));
    std::fill_n(options_.weights.begin(), first, Scalar(0));
    std::fill(options_.weights.begin() + static_cast<std::ptrdiff_t>(last) + 1, options_.weights.end(), Scalar(0));
  }

  /// Whether nothing but the poses holds the curve, or all of it is given.
  [[nodiscard]] bool priorless() const { return options_.smoothness || (spans_.empty() && !options_.hold_ends); }

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
    // Rounding leaves that much; where a prior holds control points, its weight is at least the root of rounding.
    const Scalar share = spans_.empty() ? 64 * epsilon : sqrt(epsilon);
    const Scalar extent = extent_.maxCoeff();
    const Tangent<G> found = robust_deviation<Curve>(data_, fit_.spline, counts(), free_share_,
                                                     share * (extent > Scalar(0) ? extent : Scalar(1)));
    // Of nearly as many control points as poses there are next to no residuals.
    if (taken_share_ < Scalar(3) / Scalar(4) || data_.size() < 3) return found;
    return found.cwiseMax(noise_of(data_));
  }

  FitOptions<Curve> options_;
  PosesOf<Curve> data_;
  std::optional<KnotChoice<G>> choice_;
  Fit<Curve> fit_;
  std::vector<UnmeasuredSpan<typename Curve::Time>> spans_;
  Tangent<G> noise_;    // the standard deviation of a pose, given or of the residuals
  Tangent<G> extent_;   // of the poses
  Scalar taken_share_;  // of the data that the control points take
  Scalar free_share_;   // and leave, at least a quarter
};

}  // namespace splinertia
