// SPDX-License-Identifier: MIT
// fit_trajectory() for a group and an order known at compile time. It takes long to compile, so each pair has its own
// source file in this folder.
#pragma once

#include <algorithm>
#include <optional>
#include <splinertia/calibration/inertial_fit.hpp>
#include <splinertia/spline/fit/adaptive_fit.hpp>
#include <splinertia/spline/fit/choose_knots.hpp>
#include <splinertia/spline/fit/fit.hpp>
#include <splinertia/spline/fit/interpolate.hpp>
#include <splinertia/spline/fit/knot_choice.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "support/concat.hpp"
#include "support/fitted_trajectory.hpp"
#include "support/formatted.hpp"
#include "support/pose_distances.hpp"
#include "support/progress.hpp"

namespace {

using namespace splinertia;
using std::chrono::nanoseconds;

/// Calls work(). If the library rejects its values, the message gets the name of the file and the options that help.
auto about(const std::filesystem::path& file, const char* help, const auto& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(concat(file.string(), ": ", error.what(), help));
  }
}

template <Pose G>
Tangent<G> tangent(double rotation, double position) {
  const auto r = Eigen::Vector3d::Constant(rotation), p = Eigen::Vector3d::Constant(position);
  Tangent<G> result;
  if constexpr (SplitPose<G>) {
    result << r, p;
  } else {
    result << p, r;
  }
  return result;
}

template <typename Curve>
FitOptions<Curve> fit_options(const FitChoices& o) {
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

/// Why fit() has chosen the knot interval.
inline std::string why(KnotLimit limit) {
  switch (limit) {
    case KnotLimit::motion:
      return "chosen: longer intervals would miss motion above the noise of the poses";
    case KnotLimit::poses:
      return "chosen: as close as the poses, which are sparse for the motion";
    case KnotLimit::turn:
      return "chosen: with longer intervals neighbouring control points would differ by more than 120 deg";
    case KnotLimit::length:
      break;
  }
  return "chosen: the poses show no motion that needs shorter intervals";
}

/// Adds to `result` what follows from the curve: knots, control points, smoothed poses and residuals.
template <typename Curve>
void describe_curve(const Curve& curve, const Poses& poses, FittedTrajectory& result) {
  const auto& knots = curve.knots();
  if constexpr (requires { knots.interval; }) {
    result.interval = knots.interval;
  } else {
    result.knots = knots.knots;
  }
  for (std::size_t i = 0; i < curve.control_points().size(); ++i) {
    const auto& x = curve.control_points()[i];
    result.control_points.push_back(
        {knots.control_point_time(i, Curve::order), SO3xR3<double>{rotation(x), position(x)}});
  }
  for (const auto& pose : poses) result.smoothed.push_back({pose.time, result.curve.evaluate<0>(pose.time).value});
  result.distances = distances(result.smoothed, poses);
}

/// Adds to `result` what the fit reports besides its curve.
template <typename Curve>
void describe_fit(const Fit<Curve>& fit, bool with_imu, FittedTrajectory& result) {
  const auto& deviation = fit.standard_deviation;
  constexpr bool split = SplitPose<typename Curve::Group>;
  result.rotation_deviation = split ? deviation.template head<3>() : deviation.template tail<3>();
  result.position_deviation = split ? deviation.template tail<3>() : deviation.template head<3>();
  result.outliers = fit.outliers;
  // There are no holes if the curve was fitted to an IMU, which measures it everywhere.
  for (const auto& gap : fit.gaps) {
    if (!with_imu) result.holes.push_back({gap.start, gap.end});
  }
  result.regularized_control_points = fit.regularized_control_points;
  if (fit.knot_choice) result.why_interval = why(fit.knot_choice->limit);
  result.iterations = fit.iterations;
  result.converged = fit.converged;
  result.condition = fit.condition;
}

inline InertialOptions<double> inertial_options(const FitImu& imu) {
  InertialOptions<double> options{.gyro_standard_deviation = imu.gyro_deviation.value_or(0.01),
                                  .accel_standard_deviation = imu.accel_deviation.value_or(0.1)};
  options.calibration.gravity = imu.gravity;
  options.estimate_lever_arm = imu.estimate_lever_arm;
  options.estimate_time_offset = imu.estimate_time_offset;
  return options;
}

/// The residuals of the samples within the curve.
inline FittedImu describe_imu(const CalibratedImu<double>& calibrated, const InertialOptions<double>& options,
                              const FittedTrajectory& fitted,
                              const std::vector<ImuSample<double, nanoseconds>>& samples) {
  FittedImu imu{calibrated, options.gyro_standard_deviation, options.accel_standard_deviation};
  for (const ImuSample<double, nanoseconds>& sample : samples) {
    const nanoseconds time = after(sample.time, calibrated.calibration.time_offset);
    if (time < fitted.curve.start() || time > fitted.curve.end()) continue;
    const auto reading = predicted_imu(fitted.curve.evaluate<2>(time), calibrated.calibration);
    imu.samples.push_back({sample.time, reading.gyro, reading.accel, reading.gyro - sample.gyro,
                           reading.accel - sample.accel, hole_at(fitted.holes, time).has_value()});
  }
  return imu;
}

/// Calibrates the IMU against the curve, without the samples inside holes. If the noise of the samples is not given, it
/// is estimated from the residuals of a first calibration.
template <typename Curve>
FittedImu calibrate(const Curve& curve, const FittedTrajectory& fitted, const FitImu& imu) {
  const Stage stage("calibrating the IMU");
  InertialOptions<double> options = inertial_options(imu);
  std::vector<FitGap<nanoseconds>> gaps;
  for (const Hole& hole : fitted.holes) gaps.push_back({hole.start, hole.end});
  return about(imu.file, "", [&] {
    if (!imu.gyro_deviation) {
      const CalibratedImu<double> first = calibrate_imu(curve, imu.samples, options, gaps);
      options.gyro_standard_deviation = std::max(first.gyro_rms, 1e-12);
      options.accel_standard_deviation = std::max(first.accel_rms, 1e-12);
    }
    return describe_imu(calibrate_imu(curve, imu.samples, options, gaps), options, fitted, imu.samples);
  });
}

/// Sets the knot interval from the options; without them fit() chooses it.
template <typename Curve>
void place_knots(const PosesOf<Curve>& data, const FitChoices& o, FitOptions<Curve>& options,
                 FittedTrajectory& result) {
  if (o.cross_validate) {
    const Stage stage("cross-validating knot intervals");
    CrossValidation found = cross_validated_knot_interval<Curve>(data, options);
    options.knot_interval = result.chosen_interval = found.knot_interval;
    result.tried = std::move(found.tried);
  } else if (o.goal_position) {
    const Stage stage("searching the coarsest knots that meet the goals");
    const auto goal = tangent<typename Curve::Group>(*o.goal_rotation, *o.goal_position);
    options.knot_interval = result.chosen_interval = coarsest_knot_interval<Curve>(data, goal, options);
  } else {
    options.knot_interval = o.knot_interval;
  }
}

template <Pose G, int Order>
FittedTrajectory fit_uniform(const FitInput& input, const FitChoices& o, const FitImu* imu) {
  using Curve = Spline<G, Order, UniformKnots<nanoseconds>>;
  const auto data = about(input.file, "", [&] { return convert_poses<Curve>(input.poses, "poses"); });
  FitOptions<Curve> options = fit_options<Curve>(o);
  FittedTrajectory result;
  std::optional<Fit<Curve>> fitted;
  about(input.file, " (--knot-interval; --smooth-position)", [&] {
    place_knots<Curve>(data, o, options, result);
    const Stage stage("fitting");
    fitted.emplace(fit<Curve>(data, options));
  });
  std::optional<InertialFit<Curve>> both;
  const bool together = imu && imu->fit_together;
  if (together) {
    const Stage stage("fitting poses and IMU together");
    options.standard_deviation = fitted->standard_deviation;
    if (fitted->knot_choice) options.knot_interval = fitted->knot_choice->interval;
    about(imu->file, "",
          [&] { both.emplace(inertial_fit<Curve>(data, imu->samples, options, inertial_options(*imu))); });
  }
  const Fit<Curve>& final_fit = both ? *both : *fitted;
  result.curve = AnyTrajectory(final_fit.spline);
  describe_fit(final_fit, together, result);
  describe_curve(final_fit.spline, input.poses, result);
  if (both) result.imu = describe_imu(both->imu, inertial_options(*imu), result, imu->samples);
  if (imu && !together) result.imu = calibrate(final_fit.spline, result, *imu);
  return result;
}

template <Pose G, int Order>
FittedTrajectory fit_nonuniform(const FitInput& input, const FitChoices& o, const FitImu* imu) {
  using Curve = Spline<G, Order, NonUniformKnots<nanoseconds>>;
  FittedTrajectory result;
  const Curve curve = about(input.file, "", [&]() -> Curve {
    const auto data = convert_poses<Curve>(input.poses, "poses");
    if constexpr (Order % 2 == 0) {
      if (o.interpolate) {
        const Stage stage("interpolating");
        // The criterion of fit() for gaps, with a knot at every pose.
        const double longest = 2.5 * median_interval(input.poses);
        for (std::size_t i = 1; i < data.size(); ++i) {
          if (to_seconds<double>(data[i].time - data[i - 1].time) > longest) {
            result.holes.push_back({data[i - 1].time, data[i].time});
          }
        }
        return interpolate<Curve>(data);
      }
    }
    const Stage stage("fitting with finer and finer knots");
    const auto goal = tangent<G>(*o.goal_rotation, *o.goal_position);
    Fit<Curve> fitted = adaptive_fit<Curve>(data, goal, fit_options<Curve>(o));
    describe_fit(fitted, false, result);
    return std::move(fitted.spline);
  });
  result.curve = AnyTrajectory(curve);
  describe_curve(curve, input.poses, result);
  if (imu) result.imu = calibrate(curve, result, *imu);
  return result;
}

}  // namespace

template <splinertia::Pose G, int Order>
FittedTrajectory fit_on_curve(const FitInput& input, const FitChoices& choices, const FitImu* imu) {
  return choices.adaptive || choices.interpolate ? fit_nonuniform<G, Order>(input, choices, imu)
                                                 : fit_uniform<G, Order>(input, choices, imu);
}
