// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <splinertia/message.hpp>
#include <splinertia/require.hpp>
#include <splinertia/spline/banded_system.hpp>
#include <splinertia/spline/curve_model.hpp>
#include <splinertia/spline/data_support.hpp>
#include <splinertia/spline/fit_data.hpp>
#include <splinertia/spline/fit_options.hpp>
#include <splinertia/spline/fit_residuals.hpp>
#include <splinertia/spline/gap_bridges.hpp>
#include <splinertia/spline/knots_over.hpp>
#include <splinertia/spline/least_squares.hpp>
#include <splinertia/spline/pose_term.hpp>
#include <splinertia/spline/smoothness.hpp>
#include <splinertia/spline/spline.hpp>
#include <stdexcept>
#include <vector>

namespace splinertia {

/// What fit() does, step by step. A problem that holds the same curve by other data as well goes on from here.
template <typename Curve>
  requires LieGroupWithJacobians<typename Curve::Group>
class FitProblem {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;

  /// Checks everything, chooses knots, and starts from the poses at their times. `options` is kept by reference.
  /// Throws std::invalid_argument as fit() says.
  template <StampedPoses Poses>
  FitProblem(const Poses& poses, const FitOptions<Curve>& options)
      : options_(options), data_(fit_data<Curve>(poses, "fit")), fit_{first_curve()} {
    const auto& knots = fit_.spline.knots();
    const std::size_t control_points = fit_.spline.control_points().size();
    const auto undetermined = undetermined_control_points<Curve>(knots, control_points, data_, counts());
    if (!options.smoothness && data_.size() < control_points) {
      throw std::invalid_argument(message("fit: ", data_.size(), " poses for ", control_points,
                                          " control points, expected at least as many; take knots further apart, or "
                                          "give a smoothness"));
    }
    fit_.gaps = gaps_between(data_, fit_.spline, undetermined);
    extent_ = extent_of(data_);
    const Scalar taken = Scalar(control_points - undetermined.size()) / Scalar(data_.size());
    free_share_ = Scalar(1) - std::min(taken, Scalar(3) / Scalar(4));
  }

  /// The spline nearest to the poses. Uniform knots leave the outermost control points of order 5 and more to weights
  /// so small that the noise of few poses moves them by thousands of times as much: where that is more than a rotation
  /// has room for, a second try holds the ends.
  void solve() {
    const Curve start = fit_.spline;
    try_to_solve();
    if constexpr (requires { start.knots().interval; }) {
      if (!fit_.converged && Curve::order > 4 && !options_.smoothness) {
        fit_.ends_held = true;
        fit_.spline = start;
        fit_.iterations = 0;
        try_to_solve();
      }
    }
  }

  [[nodiscard]] const Curve& curve() const { return fit_.spline; }
  [[nodiscard]] PoseTerm<Curve> pose_term(const RobustLoss& loss) const {
    return {data_, options_.weights, fit_.standard_deviation, loss};
  }
  /// What holds the curve where the poses do not.
  [[nodiscard]] SmoothnessTerms<Curve> smoothness_terms() const {
    SmoothnessTerms<Curve> result;
    const Curve& curve = fit_.spline;
    const Tangent<G>& deviation = fit_.standard_deviation;
    if (options_.smoothness) {
      result.terms.emplace_back(options_.smoothness->derivative, options_.smoothness->density, 0, curve.segments() - 1);
    } else {
      bridge(result, curve, deviation, fit_.gaps);
      if (fit_.ends_held) hold_ends(result, curve, deviation);
    }
    return result;
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

  [[nodiscard]] auto counts() const {
    return [this](std::size_t i) { return options_.weights.empty() || options_.weights[i] > Scalar(0); };
  }

  [[nodiscard]] Curve first_curve() {
    check(options_, data_.size());
    auto [knots, control_points] = knots_over<Curve>(data_, options_);
    return poses_at_control_points<Curve>(data_, std::move(knots), control_points);
  }

  /// Of a robust loss without a given deviation, in rounds, since what is an outlier depends on the deviation, and this
  /// on what is not.
  void try_to_solve() {
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
                   {.relative = std::max(relative, 16 * epsilon),
                    .absolute = epsilon * whitened_extent * whitened_extent,
                    .most_iterations = std::min(most_iterations, options_.most_iterations - fit_.iterations)});
      fit_.iterations += minimum.iterations;
      fit_.converged = minimum.converged;
    };
    if (options_.standard_deviation || options_.loss.is_squares()) {
      fit_.standard_deviation = options_.standard_deviation.value_or(Tangent<G>::Ones());
    } else {
      fit_.standard_deviation.setOnes();
      minimize_with(RobustLoss::squares(), rough, 5);
      for (int round = 0; round < 10; ++round) {
        const Tangent<G> before = fit_.standard_deviation;
        fit_.standard_deviation = deviation_of_residuals();
        if (round > 0 && fit_.standard_deviation.isApprox(before, Scalar(1) / Scalar(100))) break;
        minimize_with(options_.loss, rough, 5);
      }
    }
    // Squares converge quadratically or nearly; weights that are found anew in each step do so linearly, and what is
    // left of them moves nothing.
    minimize_with(options_.loss, options_.loss.is_squares() ? Scalar(1e-12f) : Scalar(1e-6f), options_.most_iterations);
    // The last step may have been damped, or there was none.
    fit_.condition = factor.compute(system, Scalar(0)) ? condition_estimate(system, factor)
                                                       : std::numeric_limits<Scalar>::infinity();
    if (!options_.standard_deviation) fit_.standard_deviation = deviation_of_residuals();
  }

  [[nodiscard]] Tangent<G> deviation_of_residuals() const {
    return robust_deviation<Curve>(data_, fit_.spline, counts(), free_share_, extent_.maxCoeff());
  }

  const FitOptions<Curve>& options_;
  PosesOf<Curve> data_;
  Fit<Curve> fit_;
  Tangent<G> extent_;  // of the poses
  Scalar free_share_;  // of the data that the control points do not take
};

}  // namespace splinertia
