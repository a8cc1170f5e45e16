// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/detail/chi_square.hpp>
#include <splinertia/allan/detail/model/non_negative_solution.hpp>
#include <splinertia/allan/noise_estimates.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <stdexcept>

namespace splinertia::allan {

/// Weighted least-squares fit of σ²(τ) = 3Q²/τ² + N²/τ + (2 ln 2/π)B² + K²τ/3 + R²τ²/2 (IEEE Std 952-1997, C.1) to an
/// Allan variance curve, with all coefficients ≥ 0.
///
/// The weight of a point is edf/(2σ⁴) with σ of the model, not of the point: weights from the data favour points that
/// are low by chance, which reduces K by a quarter. Neighbouring points are correlated. The correlations follow from
/// the model's spectrum and enter the standard errors, not the weights.
template <typename Scalar>
class DeviationFit {
 public:
  static constexpr int size = 5;
  using Vector = Eigen::Matrix<Scalar, size, 1>;
  using Matrix = Eigen::Matrix<Scalar, size, size>;

  explicit DeviationFit(const DeviationCurve<Scalar>& curve) : rate_(curve.rate), unit_(0), longest_(0) {
    if (curve.name != "adev" && curve.name != "oadev") {
      splinertia::detail::refuse<std::invalid_argument>("fit_curve: the curve's name is ", curve.name,
                                                        ", expected adev or oadev");
    }
    for (const auto& point : curve.points) {
      splinertia::detail::require_positive("fit_curve", "tau", point.tau);
      splinertia::detail::require_non_negative("fit_curve", "deviation", point.deviation);
      splinertia::detail::require_positive("fit_curve", "degrees of freedom", point.degrees_of_freedom);
      unit_ = (std::max)(unit_, point.deviation);
      longest_ = (std::max)(longest_, point.tau);
    }
    if (curve.points.size() < 2 || !(unit_ > 0)) {
      splinertia::detail::refuse<std::invalid_argument>("fit_curve: ", curve.points.size(),
                                                        " points, expected at least 2, and a deviation above zero");
    }
    splinertia::detail::require_positive("fit_curve", "rate", curve.rate);
    const auto count = static_cast<Eigen::Index>(curve.points.size());
    tau_.resize(count);
    basis_.resize(count, size);
    variance_.resize(count);
    freedom_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& point = curve.points[static_cast<std::size_t>(i)];
      tau_[i] = point.tau;
      for (const NoiseTerm term : detail::standard_terms) {
        basis_(i, static_cast<Eigen::Index>(term)) = allan_variance(term, point.tau);
      }
      variance_[i] = (point.deviation / unit_) * (point.deviation / unit_);
      freedom_[i] = point.degrees_of_freedom;
    }
  }

  struct Result {
    Vector theta;            ///< squares of N, K, B, Q, R, in unit()²
    Vector standard_errors;  ///< of theta; zero for terms that the model does not have
  };

  [[nodiscard]] Result fit(NoiseTerms terms) const {
    constexpr int most_steps = 100;
    Result result;
    // The first weights are those of a model that passes through the data.
    Column model = (variance_.max)(variance_.maxCoeff() * std::numeric_limits<Scalar>::epsilon());
    Vector before = Vector::Zero();
    for (int i = 0; i < most_steps; ++i) {
      result.theta = solve(terms, model);
      model = expected(result.theta);
      const Column change = (basis_ * (result.theta - before)).array().abs() / model;
      if (change.maxCoeff() < Scalar(1e-9)) break;
      before = result.theta;
    }
    result.standard_errors = standard_errors(terms, result.theta, model);
    return result;
  }

  /// A term's estimate over its standard error if it were zero, with weights and correlations of the model without it.
  /// The standard error of the full model grows with the term and would hide it.
  [[nodiscard]] Scalar significance(NoiseTerms terms, NoiseTerm term) const {
    const auto j = static_cast<Eigen::Index>(term);
    const Vector without = fit(terms.without(term)).theta;
    const Column model = expected(without);
    const Scalar error = standard_errors(terms, without, model)[j];
    return error > 0 ? solve(terms, model)[j] / error : Scalar(0);
  }

  [[nodiscard]] Scalar unit() const { return unit_; }

 private:
  using Column = Eigen::Array<Scalar, Eigen::Dynamic, 1>;
  using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, size>;
  using Square = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  [[nodiscard]] Column expected(const Vector& theta) const {
    return ((basis_ * theta).array().max)((std::numeric_limits<Scalar>::min)());
  }

  /// One step of least squares with the weights of a model.
  [[nodiscard]] Vector solve(NoiseTerms terms, const Column& model) const {
    unsigned candidates = 0;
    for (const NoiseTerm term : detail::standard_terms) {
      if (terms.has(term)) candidates |= 1u << static_cast<unsigned>(term);
    }
    const Column weights = freedom_ / (2 * model.square());
    const Matrix information = basis_.transpose() * weights.matrix().asDiagonal() * basis_;
    const Vector product = basis_.transpose() * (weights * variance_).matrix();
    return detail::non_negative_solution<Scalar, size>(information, product, candidates);
  }

  /// Standard errors of weighted least squares with correlated errors, from (XᵀWX)⁻¹ XᵀW C WX (XᵀWX)⁻¹ over the terms
  /// of the model.
  [[nodiscard]] Vector standard_errors(NoiseTerms terms, const Vector& theta, const Column& model) const {
    const Column weights = freedom_ / (2 * model.square());
    const Square root_covariance = weights.sqrt().inverse().matrix().asDiagonal();
    const Square covariance = root_covariance * correlations(theta) * root_covariance;
    const Rows weighted = weights.matrix().asDiagonal() * basis_;
    Matrix information = basis_.transpose() * weighted;
    Matrix scatter = weighted.transpose() * covariance * weighted;
    Vector scale = information.diagonal().cwiseSqrt().cwiseInverse();
    information = scale.asDiagonal() * information * scale.asDiagonal();
    scatter = scale.asDiagonal() * scatter * scale.asDiagonal();
    for (const NoiseTerm term : detail::standard_terms) {
      const auto j = static_cast<Eigen::Index>(term);
      if (terms.has(term)) continue;
      information.row(j).setZero();
      information.col(j).setZero();
      information(j, j) = 1;
      scatter.row(j).setZero();
      scatter.col(j).setZero();
    }
    const Matrix inverse = information.fullPivLu().inverse();
    return scale.cwiseProduct((inverse * scatter * inverse).diagonal().cwiseMax(Scalar(0)).cwiseSqrt());
  }

  /// Correlations of the points' variances: ∫ S² H_i H_j df, normalised. S is the model's spectrum (SP 1065) and
  /// H = sin⁴(πfτ)/(πfτ)² the squared frequency response of the Allan deviation (integral: Percival and Walden,
  /// "Wavelet Methods for Time Series Analysis" (2000)).
  [[nodiscard]] Square correlations(const Vector& theta) const {
    constexpr int per_octave = 40;
    const Scalar pi = splinertia::detail::pi_of<Scalar>();
    const Scalar highest = rate_ / 2, lowest = 1 / (32 * longest_);
    const int count = per_octave * (std::max)(1, 1 + static_cast<int>(std::log2(highest / lowest)));
    Square seen(basis_.rows(), count);
    for (int k = 0; k < count; ++k) {
      const Scalar f = highest * std::exp2(-static_cast<Scalar>(k) / per_octave);
      const Scalar w = 2 * pi * f;
      // A ramp has no spectrum. It is replaced by a random walk with the same variance at the longest tau.
      const Scalar spectrum =
          theta[0] + (theta[1] + theta[4] * longest_ * 3 / 2) / (w * w) + theta[2] / w + theta[3] * w * w;
      for (Eigen::Index i = 0; i < basis_.rows(); ++i) {
        const Scalar x = pi * f * tau_[i];
        const Scalar sine = std::sin(x);
        seen(i, k) = spectrum * std::sqrt(f) * (sine * sine / x) * (sine * sine / x);
      }
    }
    const Column norms = (seen.rowwise().norm().array().max)((std::numeric_limits<Scalar>::min)());
    const Square normalised = norms.inverse().matrix().asDiagonal() * seen;
    return normalised * normalised.transpose();
  }

  Scalar rate_;  // Hz
  Scalar unit_;
  Scalar longest_;  // tau, s
  Rows basis_;
  Column tau_, variance_, freedom_;
};

namespace detail {

/// The candidates that stay when terms of less significance than `detection` are removed one by one. Of terms that
/// explain the same power the random walk stays, which estimators model.
template <typename Scalar>
[[nodiscard]] NoiseTerms significant_terms(const DeviationFit<Scalar>& fit, NoiseTerms candidates, Scalar detection) {
  NoiseTerms model = candidates;
  for (const NoiseTerm term : {NoiseTerm::rate_ramp, NoiseTerm::quantization, NoiseTerm::bias_instability,
                               NoiseTerm::random_walk, NoiseTerm::white}) {
    if (!model.has(term) || model == NoiseTerms{term} || fit.significance(model, term) >= detection) continue;
    model = model.without(term);
  }
  return model;
}

}  // namespace detail

/// N, K, B, Q and R from a curve alone, when there is no signal for identify(): a curve from a paper or from a stream.
/// All `candidates` but G and W are fitted together; terms that are not significant at 1 % are removed one by one.
/// Intervals of detected terms are those of a chi-square distribution with the degrees of freedom that the standard
/// error implies. In simulated logs of 2 hours (docs/performance.md) N scatters 1.4 times and K 1.1 to 1.3 times as
/// much as with identify(), and 95 % intervals of K hold in 87 to 92 %. Throws std::invalid_argument for a curve other
/// than adev or oadev, fewer than two points, values in it that are not finite or out of range, no deviation above
/// zero, no candidates, and a confidence not between 0 and 1.
template <typename Scalar>
[[nodiscard]] NoiseEstimates<Scalar> fit_curve(const DeviationCurve<Scalar>& curve,
                                               NoiseTerms candidates = NoiseTerms::all(),
                                               Scalar confidence = Scalar(95) / 100) {
  splinertia::detail::require(confidence > 0 && confidence < 1, "fit_curve", "confidence", confidence,
                              "a number between 0 and 1");
  for (const NoiseTerm term : {NoiseTerm::gauss_markov, NoiseTerm::warm_up}) candidates = candidates.without(term);
  if (candidates.empty())
    splinertia::detail::refuse<std::invalid_argument>("fit_curve: no candidates, expected a noise term");
  const DeviationFit<Scalar> fit(curve);
  const Scalar detection =
      std::sqrt(detail::chi_square_quantile(Scalar(98) / 100, Scalar(1)));  // exceeded in 1 % of logs
  const NoiseTerms model = detail::significant_terms(fit, candidates, detection);
  const auto result = fit.fit(model);
  NoiseEstimates<Scalar> estimates;
  estimates.highest_frequency = curve.rate / 2;
  estimates.duration = static_cast<Scalar>(curve.samples) / curve.rate;
  estimates.descriptions.push_back({.terms = model});
  for (const NoiseTerm term : detail::standard_terms) {
    if (!candidates.has(term)) continue;
    const auto j = static_cast<Eigen::Index>(term);
    const auto with_term = model.has(term) ? result : fit.fit(model.with(term));
    const Scalar theta = with_term.theta[j], error = with_term.standard_errors[j];
    Estimate<Scalar>& estimate = estimates[term];
    estimate.detected = model.has(term) && theta > 0;
    const auto within = [&](Scalar level) {
      if (estimate.detected) {
        const Scalar freedom = 2 * (theta / error) * (theta / error);
        return detail::deviation_interval(std::sqrt(theta) * fit.unit(), freedom, level);
      }
      const Scalar half = std::sqrt(detail::chi_square_quantile(level, Scalar(1))) * error;
      return Interval<Scalar>{Scalar(0), std::sqrt(theta + half) * fit.unit()};
    };
    estimate.value = std::sqrt(theta) * fit.unit();
    if (estimate.detected) estimates.descriptions.front().values[static_cast<std::size_t>(term)] = estimate.value;
    estimate.interval = within(confidence);
    estimate.one_sigma = within(detail::one_sigma<Scalar>);
  }
  return estimates;
}

}  // namespace splinertia::allan
