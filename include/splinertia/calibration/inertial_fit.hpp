// SPDX-License-Identifier: MIT
/// Fits a spline to poses and the samples of an IMU together, and estimates the calibration of the IMU.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <ranges>
#include <splinertia/calibration/detail/inertial_term.hpp>
#include <splinertia/calibration/imu_calibration.hpp>
#include <splinertia/calibration/inertial_options.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace splinertia {

/// An estimated calibration and its quality.
template <typename Scalar>
struct CalibratedImu {
  ImuCalibration<Scalar> calibration;
  /// Standard deviations, as the given noise of samples and poses implies; 0 for what is not estimated. For what the
  /// motion does not show they are infinite or huge, and the estimate is arbitrary.
  struct {
    Eigen::Vector3<Scalar> gyro_bias, accel_bias, lever_arm;
    Eigen::Matrix<Scalar, 2, 1> gravity_direction;  ///< rad, towards each column of gravity_tangent()
    Scalar time_offset;
  } standard_deviation;
  Scalar gyro_rms;      ///< of the residuals over all axes, rad/s
  Scalar accel_rms;     ///< the same, m/s²
  std::size_t samples;  ///< how many are within the curve and outside its gaps
  int iterations;
  bool converged;
};

template <typename Curve>
struct InertialFit : Fit<Curve> {
  CalibratedImu<typename Curve::Scalar> imu;
};

namespace detail {

/// When to stop. With noise each residual contributes about 1 to the cost, beside which a change of 1e-10 of the cost
/// is negligible. Without noise only rounding is left, which the absolute limit allows for.
template <typename Scalar>
[[nodiscard]] Convergence<Scalar> inertial_convergence(std::size_t samples, int most_iterations) {
  constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  return {.relative = (std::max)(Scalar(1e-10f), 16 * epsilon),
          .absolute = epsilon * static_cast<Scalar>(6 * samples),
          .most_iterations = most_iterations};
}

/// A curve and a calibration, for minimize().
template <typename Curve>
struct InertialState {
  Curve curve;
  ImuCalibration<typename Curve::Scalar> calibration;
};

template <typename Curve>
using InertialSystem =
    BandedSystem<typename Curve::Scalar, DofOf<typename Curve::Group>, Curve::order - 1, CalibrationRows::count>;

/// A model for minimize(): the unknowns are the curve, which has other terms as well, and the calibration.
template <typename Curve, typename... CurveTerms>
class InertialModel {
 public:
  InertialModel(std::reference_wrapper<const InertialTerm<Curve>> samples,
                std::reference_wrapper<const CurveTerms>... terms)
      : samples_(samples), terms_(terms...) {}

  auto linearize(const InertialState<Curve>& state, InertialSystem<Curve>& system) const {
    auto cost = samples_.add(state.curve, state.calibration, system);
    std::apply([&](const auto&... term) { ((cost += term.add(state.curve, system)), ...); }, terms_);
    return cost;
  }

  [[nodiscard]] InertialState<Curve> retracted(const InertialState<Curve>& state,
                                               const typename InertialSystem<Curve>::Vector& step) const {
    return {detail::retracted(state.curve, step.blocks), samples_.retracted(state.calibration, step.border)};
  }

 private:
  const InertialTerm<Curve>& samples_;
  std::tuple<const CurveTerms&...> terms_;
};

template <typename Curve, typename... CurveTerms>
InertialModel(const InertialTerm<Curve>&, const CurveTerms&...) -> InertialModel<Curve, CurveTerms...>;

/// Adds only to the border of the equations, because the curve is known.
template <typename System>
struct BorderOnly {
  System& system;
  typename System::Corner& corner;

  void add(std::size_t, const auto& r, const auto&, const auto& border) { system.add_border(r, border); }
};

/// A model for minimize(): the unknown is the calibration alone.
template <typename Curve>
class CalibrationModel {
 public:
  using Calibration = ImuCalibration<typename Curve::Scalar>;

  CalibrationModel(std::reference_wrapper<const InertialTerm<Curve>> samples, std::reference_wrapper<const Curve> curve)
      : samples_(samples), curve_(curve) {}

  auto linearize(const Calibration& calibration, InertialSystem<Curve>& system) const {
    BorderOnly<InertialSystem<Curve>> border{system, system.corner};
    return samples_.add(curve_, calibration, border);
  }

  [[nodiscard]] Calibration retracted(const Calibration& calibration,
                                      const typename InertialSystem<Curve>::Vector& step) const {
    return samples_.retracted(calibration, step.border);
  }

 private:
  const InertialTerm<Curve>& samples_;
  const Curve& curve_;
};

/// The standard deviations of all unknowns of a calibration, at the minimum. `factor` is overwritten.
template <typename Curve>
[[nodiscard]] auto calibration_deviation(const InertialSystem<Curve>& system,
                                         BandedCholesky<InertialSystem<Curve>>& factor) {
  using std::sqrt;
  using Scalar = typename Curve::Scalar;
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  Eigen::Matrix<Scalar, CalibrationRows::count, 1> deviation;
  deviation.setConstant(infinity);
  // If unknowns cannot be told apart to rounding, a little damping makes the system regular. Then unknowns whose
  // variance comes near what the damping allows are not observable. The others are not affected.
  const Scalar little = sqrt(std::numeric_limits<Scalar>::epsilon());
  const bool regular = factor.compute(system, Scalar(0));
  if (!regular && !factor.compute(system, little)) return deviation;
  const auto covariance = factor.border_covariance();
  for (int i = 0; i < CalibrationRows::count; ++i) {
    const Scalar information = system.corner(i, i), variance = covariance(i, i);
    const bool seen = information > InertialTerm<Curve>::nothing &&
                      (regular || variance * information * little < Scalar(1) / Scalar(100));
    if (seen) deviation[i] = sqrt(variance);
  }
  return deviation;
}

/// The result of minimize() with its standard deviations.
template <typename Curve>
[[nodiscard]] CalibratedImu<typename Curve::Scalar> estimated_calibration(
    const InertialTerm<Curve>& samples, const Curve& curve, const ImuCalibration<typename Curve::Scalar>& calibration,
    const InertialSystem<Curve>& system, BandedCholesky<InertialSystem<Curve>>& factor,
    const Minimum<typename Curve::Scalar>& minimum) {
  using Scalar = typename Curve::Scalar;
  using Rows = CalibrationRows;
  const Eigen::Matrix<Scalar, Rows::count, 1> deviation =
      samples.estimated().select(calibration_deviation<Curve>(system, factor), Scalar(0));
  const auto [gyro_rms, accel_rms] = samples.rms(curve, calibration);
  return {calibration,
          {deviation.template segment<3>(Rows::gyro_bias), deviation.template segment<3>(Rows::accel_bias),
           deviation.template segment<3>(Rows::lever_arm), deviation.template segment<2>(Rows::gravity),
           deviation[Rows::time_offset]},
          gyro_rms,
          accel_rms,
          samples.size(),
          minimum.iterations,
          minimum.converged};
}

}  // namespace detail

/// Estimates the calibration of an IMU from its samples along a known curve. The residuals show how well the curve, and
/// a simulation along it, matches the real sensor.
///
///   const auto imu = calibrate_imu(fit.spline, samples, {.gyro_standard_deviation = 0.01,
///                                                        .accel_standard_deviation = 0.1});
///   imu.calibration.gyro_bias;  imu.standard_deviation.gyro_bias;  imu.gyro_rms;
///
/// `samples` is any range of `time`, `gyro`, `accel` (ImuSampleLike), in ascending order. Samples inside the `gaps` of
/// the curve are left out, because no data support the curve there. Throws std::invalid_argument for bad samples or
/// options, and if no sample is within the curve and outside its gaps.
template <typename Curve, std::ranges::forward_range Samples>
  requires Pose<typename Curve::Group>
[[nodiscard]] CalibratedImu<typename Curve::Scalar> calibrate_imu(
    const Curve& curve, const Samples& samples, const InertialOptions<typename Curve::Scalar>& options,
    const std::vector<FitGap<typename Curve::Time>>& gaps = {}) {
  const detail::InertialTerm<Curve> term(samples, options, curve, gaps);
  detail::InertialSystem<Curve> system(0);
  detail::BandedCholesky<detail::InertialSystem<Curve>> factor;
  auto calibration = options.calibration;
  const auto minimum = detail::minimize(detail::CalibrationModel<Curve>(term, curve), calibration, system, factor,
                                        detail::inertial_convergence<typename Curve::Scalar>(term.size(), 100));
  return detail::estimated_calibration(term, curve, calibration, system, factor, minimum);
}

/// The same for a curve that was fitted to poses: samples inside its gaps are left out.
template <typename Curve, std::ranges::forward_range Samples>
  requires Pose<typename Curve::Group>
[[nodiscard]] CalibratedImu<typename Curve::Scalar> calibrate_imu(
    const Fit<Curve>& fit, const Samples& samples, const InertialOptions<typename Curve::Scalar>& options) {
  return calibrate_imu(fit.spline, samples, options, fit.gaps);
}

/// The spline nearest to poses and to the samples of an IMU together, and the IMU's calibration. Residuals are divided
/// by their standard deviations. Give the `standard_deviation` of a pose; by default fit() estimates it from the
/// residuals. If poses are sparse or noisy, the IMU's rates allow closer knots than the poses alone can determine. If
/// they have gaps, the IMU bridges them.
///
/// The search starts from fit(poses, options) or, if that has the lower cost, from the poses at their times.
///
/// Memory and time are linear in the number of poses and samples. Throws as fit() and calibrate_imu() do.
template <typename Curve, detail::StampedPoses Poses, std::ranges::forward_range Samples>
  requires Pose<typename Curve::Group> && LieGroupWithJacobians<typename Curve::Group>
[[nodiscard]] InertialFit<Curve> inertial_fit(const Poses& poses, const Samples& samples,
                                              const FitOptions<Curve>& options,
                                              const InertialOptions<typename Curve::Scalar>& imu) {
  using Scalar = typename Curve::Scalar;
  detail::FitProblem<Curve> problem(poses, options);
  const Curve unfitted = problem.curve();
  problem.solve();
  const detail::InertialTerm<Curve> samples_term(samples, imu, problem.curve());
  const detail::PoseTerm<Curve> pose_term = problem.pose_term(options.loss);
  const detail::SmoothnessTerms<Curve> smoothness = problem.smoothness_terms(samples_term.times());
  const detail::InertialModel model(samples_term, pose_term, smoothness);
  detail::InertialSystem<Curve> system(unfitted.control_points().size());
  const auto start = [&](const Curve& curve) {
    detail::InertialState<Curve> state{curve, calibrate_imu(curve, samples, imu, problem.gaps()).calibration};
    system.clear();
    const Scalar cost = model.linearize(state, system);
    return std::pair(cost, std::move(state));
  };
  // Across a gap, or with knots that the poses hardly determine, the fit to the poses alone can be far off.
  auto [cost, state] = start(problem.curve());
  auto [cost_of_unfitted, unfitted_state] = start(unfitted);
  if (cost_of_unfitted < cost) state = std::move(unfitted_state);
  system.clear();
  detail::BandedCholesky<detail::InertialSystem<Curve>> factor;
  const auto minimum = detail::minimize(
      model, state, system, factor, detail::inertial_convergence<Scalar>(samples_term.size(), options.most_iterations));
  auto calibrated =
      detail::estimated_calibration(samples_term, state.curve, state.calibration, system, factor, minimum);
  InertialFit<Curve> result{std::move(problem).report(std::move(state.curve)), std::move(calibrated)};
  result.iterations += minimum.iterations;
  result.converged = minimum.converged;
  result.condition = factor.compute(system, Scalar(0)) ? detail::condition_estimate(system, factor)
                                                       : std::numeric_limits<Scalar>::infinity();
  return result;
}

}  // namespace splinertia
