// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/splinertia.hpp>
#include <utility>

#include "fitted_trajectory.hpp"
#include "support/progress.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

template <Pose G>
Tangent<G> tangent(const Eigen::Vector3d& rotation, const Eigen::Vector3d& position) {
  Tangent<G> result;
  if constexpr (SplitPose<G>) {
    result << rotation, position;
  } else {
    result << position, rotation;
  }
  return result;
}

template <Pose G>
Tangent<G> tangent(double rotation, double position) {
  return tangent<G>(Eigen::Vector3d::Constant(rotation), Eigen::Vector3d::Constant(position));
}

template <typename Curve>
FitOptions<Curve> fit_options(const Options& o) {
  using G = typename Curve::Group;
  FitOptions<Curve> options;
  if (o.loss == "huber") options.loss = RobustLoss::huber();
  if (o.loss == "cauchy") options.loss = RobustLoss::cauchy();
  if (o.position_deviation) options.standard_deviation = tangent<G>(*o.rotation_deviation, *o.position_deviation);
  if (o.position_density) {
    options.smoothness = {o.smooth_derivative, tangent<G>(*o.rotation_density, *o.position_density)};
  }
  options.outlier_limit = o.outlier_limit;
  options.most_iterations = o.most_iterations;
  return options;
}

/// What can be seen of a curve, once it is there.
template <typename Curve>
void describe_curve(const Curve& curve, const Poses& poses, const Options& o, FittedTrajectory& result) {
  const std::size_t count = curve.control_points().size();
  const auto& knots = curve.knots();
  result.start = curve.start();
  result.end = curve.end();
  if constexpr (requires { knots.interval; }) {
    result.interval = knots.interval;
  } else {
    result.knots = knots.knots;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto& x = curve.control_points()[i];
    result.control_points.push_back(
        {knots.control_point_time(i, Curve::order), SO3xR3<double>{rotation(x), position(x)}});
  }
  for (const auto& [time, pose] : poses) {
    const auto value = curve.template evaluate<0>(time).value;
    result.smoothed.push_back({time, SO3xR3<double>{rotation(value), position(value)}});
  }
  result.distances = distances(curve, poses);
  for (const auto& reading : simulate(curve, Imu{}, {.rate = o.rate, .gravity = o.gravity_vector()})) {
    result.derived.push_back({reading.time, reading.gyro, reading.accel});
  }
}

/// What a fit says beside its curve.
template <typename Curve>
void describe_fit(const Fit<Curve>& fit, FittedTrajectory& result) {
  const auto& deviation = fit.standard_deviation;
  constexpr bool split = SplitPose<typename Curve::Group>;
  result.rotation_deviation = split ? deviation.template head<3>() : deviation.template tail<3>();
  result.position_deviation = split ? deviation.template tail<3>() : deviation.template head<3>();
  result.outliers = fit.outliers;
  result.gaps = fit.gaps;
  result.iterations = fit.iterations;
  result.converged = fit.converged;
  result.ends_held = fit.ends_held;
  result.condition = fit.condition;
}

InertialOptions<double> inertial_options(const Options& o) {
  InertialOptions<double> options{.gyro_standard_deviation = o.gyro_deviation.value_or(0.01),
                                  .accel_standard_deviation = o.accel_deviation.value_or(0.1)};
  options.calibration.gravity = o.gravity_vector();
  options.estimate_lever_arm = o.estimate_lever_arm;
  options.estimate_time_offset = o.estimate_time_offset;
  return options;
}

/// The residuals of the samples that the calibration was made of.
template <typename Curve>
FittedImu describe_imu(const CalibratedImu<double>& calibrated, const InertialOptions<double>& options,
                       const Curve& curve, const std::vector<EurocImu>& samples) {
  FittedImu imu{calibrated, options.gyro_standard_deviation, options.accel_standard_deviation};
  for (const EurocImu& sample : samples) {
    const nanoseconds time = after(sample.time, calibrated.calibration.time_offset);
    if (time < curve.start() || time > curve.end()) continue;
    const auto reading = calibrated_imu(curve.template evaluate<2>(time), calibrated.calibration);
    imu.samples.push_back(
        {sample.time, reading.gyro, reading.accel, reading.gyro - sample.gyro, reading.accel - sample.accel});
  }
  return imu;
}

/// Of samples whose noise is not known it is what they leave.
template <typename Curve>
FittedImu calibrate(const Curve& curve, const std::vector<EurocImu>& samples, const Options& o) {
  const Stage stage("calibrating the IMU");
  InertialOptions<double> options = inertial_options(o);
  return about(o.imu, [&] {
    if (!o.gyro_deviation) {
      const CalibratedImu<double> first = calibrate_imu(curve, samples, options);
      options.gyro_standard_deviation = std::max(first.gyro_rms, 1e-12);
      options.accel_standard_deviation = std::max(first.accel_rms, 1e-12);
    }
    return describe_imu(calibrate_imu(curve, samples, options), options, curve, samples);
  });
}

template <Pose G, int Order>
FittedTrajectory fit_uniform(const Poses& poses, const std::vector<EurocImu>& samples, const Options& o) {
  using Curve = UniformCurve<G, Order>;
  FittedTrajectory result;
  FitOptions<Curve> options = fit_options<Curve>(o);
  std::optional<Fit<Curve>> fitted;
  about(o.trajectory, [&] {
    const auto data = fit_data<Curve>(poses, "poses");
    if (o.cross_validate) {
      const Stage stage("cross-validating knot intervals");
      const CrossValidation found = cross_validated_knot_interval<Curve>(data, options);
      result.chosen_interval = found.knot_interval;
      result.tried = found.tried;
    } else if (o.goal_position) {
      const Stage stage("searching the coarsest knots that meet the goals");
      result.chosen_interval =
          coarsest_knot_interval<Curve>(data, tangent<G>(*o.goal_rotation, *o.goal_position), options);
    }
    options.knot_interval =
        result.chosen_interval ? *result.chosen_interval : o.knot_interval.value_or(default_knot_interval(poses));
    const Stage stage("fitting");
    fitted.emplace(fit<Curve>(data, options));
  });
  if (o.fit_imu) {
    about(o.imu, [&] {
      const Stage stage("fitting poses and IMU together");
      const InertialOptions<double> inertial = inertial_options(o);
      options.standard_deviation = fitted->standard_deviation;
      InertialFit<Curve> both = inertial_fit<Curve>(fit_data<Curve>(poses, "poses"), samples, options, inertial);
      result.imu = describe_imu(both.imu, inertial, both.spline, samples);
      fitted.emplace(std::move(both));
    });
  } else if (!o.imu.empty()) {
    result.imu = calibrate(fitted->spline, samples, o);
  }
  describe_fit(*fitted, result);
  describe_curve(fitted->spline, poses, o, result);
  return result;
}

template <Pose G, int Order>
FittedTrajectory fit_nonuniform(const Poses& poses, const std::vector<EurocImu>& samples, const Options& o) {
  using Curve = Spline<G, Order, NonUniformKnots<nanoseconds>>;
  FittedTrajectory result;
  const Curve curve = about(o.trajectory, [&]() -> Curve {
    const auto data = fit_data<Curve>(poses, "poses");
    if constexpr (Order % 2 == 0) {
      if (o.interpolate) {
        const Stage stage("interpolating");
        return interpolate<Curve>(data);
      }
    }
    const Stage stage("fitting with finer and finer knots");
    Fit<Curve> fitted =
        adaptive_fit<Curve>(data, tangent<G>(*o.goal_rotation, *o.goal_position), fit_options<Curve>(o));
    describe_fit(fitted, result);
    return std::move(fitted.spline);
  });
  if (!o.imu.empty()) result.imu = calibrate(curve, samples, o);
  describe_curve(curve, poses, o, result);
  return result;
}

}  // namespace

template <Pose G>
FittedTrajectory fit_trajectory(const Poses& poses, const std::vector<EurocImu>& samples, const Options& options) {
  const auto with_order = [&]<int Order>() {
    return options.adaptive || options.interpolate ? fit_nonuniform<G, Order>(poses, samples, options)
                                                   : fit_uniform<G, Order>(poses, samples, options);
  };
  switch (options.order) {
    case 4:
      return with_order.template operator()<4>();
    case 5:
      return with_order.template operator()<5>();
    default:
      return with_order.template operator()<6>();
  }
}
