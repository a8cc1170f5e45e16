// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <ranges>
#include <splinertia/calibration/imu_calibration.hpp>
#include <splinertia/calibration/inertial_options.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/spline/fit/detail/pose_between.hpp>
#include <splinertia/spline/fit/fit_options.hpp>
#include <splinertia/spline/kinematics_jacobians.hpp>
#include <stdexcept>
#include <vector>

namespace splinertia::detail {

/// The first row of each part in the vector of the unknowns of a calibration.
struct CalibrationRows {
  static constexpr int gyro_bias = 0, accel_bias = 3, gravity = 6, lever_arm = 8, time_offset = 11, count = 12;
};

/// Throws std::invalid_argument for options that are missing, not finite or out of range.
template <typename Scalar>
void check_options(const InertialOptions<Scalar>& options) {
  require_positive("InertialOptions", "gyro_standard_deviation", options.gyro_standard_deviation);
  require_positive("InertialOptions", "accel_standard_deviation", options.accel_standard_deviation);
  require_positive("InertialOptions", "largest_time_offset", options.largest_time_offset);
  require_positive("InertialOptions", "the magnitude of gravity", options.calibration.gravity.norm());
  require_finite("InertialOptions", "time_offset", options.calibration.time_offset);
  if (options.estimate_time_offset && std::abs(options.calibration.time_offset) > options.largest_time_offset) {
    refuse<std::invalid_argument>("InertialOptions: time_offset is ", options.calibration.time_offset,
                                  " s, expected a magnitude of at most largest_time_offset, ",
                                  options.largest_time_offset);
  }
  const auto& from = options.calibration;
  if (!all_finite(from.gyro_bias) || !all_finite(from.accel_bias) || !all_finite(from.mounting.p_BI)) {
    refuse<std::invalid_argument>("InertialOptions: expected biases and lever arm to be finite");
  }
}

/// Two axes B orthogonal to gravity and of its length, m/s²: to first order, g + B ξ is g turned by ξ rad.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 3, 2> gravity_tangent(const Eigen::Vector3<Scalar>& gravity) {
  Eigen::Matrix<Scalar, 3, 2> basis;
  int smallest;
  gravity.cwiseAbs().minCoeff(&smallest);
  basis.col(0) = gravity.cross(Eigen::Vector3<Scalar>::Unit(smallest)).normalized();
  basis.col(1) = gravity.normalized().cross(basis.col(0));
  return basis * gravity.norm();
}

/// The least-squares term of an IMU's samples: squared differences from predicted_imu() along a curve, to be minimised
/// over the control points and the calibration, or over the calibration alone.
template <typename Curve>
class InertialTerm {
 public:
  using G = typename Curve::Group;
  using Scalar = typename Curve::Scalar;
  using Time = typename Curve::Time;
  using Rows = CalibrationRows;
  /// The diagonal element of an unknown about which there is no information.
  static constexpr Scalar nothing = (std::numeric_limits<Scalar>::min)();

  /// Samples outside the curve or inside its `gaps` are left out. Throws std::invalid_argument for a sample that is not
  /// finite or not later than the one before it, for bad options, and if no sample is left.
  template <std::ranges::forward_range Samples>
    requires ImuSampleLike<std::ranges::range_value_t<Samples>>
  InertialTerm(const Samples& samples, const InertialOptions<Scalar>& options, const Curve& curve,
               const std::vector<FitGap<Time>>& gaps = {})
      : options_(options) {
    check_options(options);
    const double margin = options.estimate_time_offset ? options.largest_time_offset : 0;
    const double offset = options.estimate_time_offset ? 0 : options.calibration.time_offset;
    std::size_t i = 0;
    Time before{};
    for (const auto& sample : samples) {
      const Time time = as_time<Time>(sample.time);
      if (!is_finite(sample.time) || !all_finite(sample.gyro) || !all_finite(sample.accel)) {
        refuse<std::invalid_argument>("IMU sample ", i, " is not finite");
      }
      if (i > 0 && !(time > before)) {
        refuse<std::invalid_argument>("IMU sample ", i, " is at time ", seconds_or_ticks(time),
                                      ", expected a time after ", seconds_or_ticks(before),
                                      ", that of the sample before it");
      }
      before = time;
      ++i;
      if (after(time, offset - margin) < curve.start() || after(time, offset + margin) > curve.end()) continue;
      const auto inside = [&](const FitGap<Time>& gap) {
        return after(time, offset + margin) > gap.start && after(time, offset - margin) < gap.end;
      };
      if (std::any_of(gaps.begin(), gaps.end(), inside)) continue;
      samples_.push_back({time, sample.gyro, sample.accel});
    }
    if (samples_.empty()) {
      refuse<std::invalid_argument>("IMU: none of ", i, " samples is within the curve, which reaches from ",
                                    seconds_or_ticks(curve.start()), " to ", seconds_or_ticks(curve.end()),
                                    gaps.empty() ? "" : ", and outside its gaps");
    }
  }

  /// The times of the samples by the curve's clock, ascending.
  [[nodiscard]] std::vector<Time> times() const {
    std::vector<Time> result;
    for (const auto& sample : samples_) result.push_back(after(sample.time, options_.calibration.time_offset));
    return result;
  }

  [[nodiscard]] std::size_t size() const { return samples_.size(); }

  /// Adds the samples to the normal equations, whose border are the unknowns of the calibration. Returns the cost.
  template <typename System>
  Scalar add(const Curve& curve, const ImuCalibration<Scalar>& calibration, System& system) const {
    Scalar cost(0);
    const auto gravity_axes = gravity_tangent<Scalar>(calibration.gravity);
    const Eigen::Matrix3<Scalar> to_imu = calibration.mounting.R_BI.matrix().transpose();
    const Eigen::Vector3<Scalar>& l = calibration.mounting.p_BI;
    Eigen::Matrix<Scalar, 6, 1> weight;
    weight.template head<3>().setConstant(Scalar(1) / options_.gyro_standard_deviation);
    weight.template tail<3>().setConstant(Scalar(1) / options_.accel_standard_deviation);
    for (const auto& sample : samples_) {
      const Time time = std::clamp(after(sample.time, calibration.time_offset), curve.start(), curve.end());
      const auto at = curve.template linearize<2>(time);
      const auto reading = predicted_imu(at, calibration);
      Eigen::Matrix<Scalar, 6, 1> r;
      r.template head<3>() = reading.gyro - sample.gyro;
      r.template tail<3>() = reading.accel - sample.accel;
      r = r.cwiseProduct(weight).eval();
      cost += r.squaredNorm();

      const Eigen::Vector3<Scalar> omega = angular_velocity(at), alpha = angular_acceleration(at);
      const Eigen::Vector3<Scalar> force = specific_force(at, calibration.gravity);
      std::array<Eigen::Matrix<Scalar, 6, 6>, Curve::order> J;
      const Eigen::Matrix3<Scalar> swing = hat<Scalar>(omega.cross(l)) + hat<Scalar>(omega) * hat<Scalar>(l);
      for (std::size_t j = 0; j < J.size(); ++j) {
        const auto omega_j = angular_velocity_jacobian(at, j);
        J[j].template topRows<3>() = to_imu * omega_j;
        J[j].template bottomRows<3>() =
            to_imu * (specific_force_jacobian(at, j, force, calibration.gravity) -
                      hat<Scalar>(l) * angular_acceleration_jacobian(at, j) - swing * omega_j);
        J[j] = weight.asDiagonal() * J[j];
      }
      Eigen::Matrix<Scalar, 6, Rows::count> border = Eigen::Matrix<Scalar, 6, Rows::count>::Zero();
      if (options_.estimate_gyro_bias) border.template block<3, 3>(0, Rows::gyro_bias).setIdentity();
      if (options_.estimate_accel_bias) border.template block<3, 3>(3, Rows::accel_bias).setIdentity();
      if (options_.estimate_gravity_direction) {
        border.template block<3, 2>(3, Rows::gravity) =
            -to_imu * rotation_matrix_transposed<Scalar>(rotation(at.value).unit_quaternion()) * gravity_axes;
      }
      if (options_.estimate_lever_arm) {
        border.template block<3, 3>(3, Rows::lever_arm) =
            to_imu * (hat<Scalar>(alpha) + hat<Scalar>(omega) * hat<Scalar>(omega));
      }
      if (options_.estimate_time_offset) {
        border.col(Rows::time_offset) = predicted_imu_rate(curve.template evaluate<3>(time), calibration);
      }
      border = weight.asDiagonal() * border;
      system.add(at.first, r, J, border);
    }
    // An unknown that is not estimated, or that no sample shows, is decoupled from the others and keeps its value.
    for (int i = 0; i < Rows::count; ++i) {
      if (system.corner(i, i) == Scalar(0)) system.corner(i, i) = nothing;
    }
    return cost;
  }

  /// calibration ⊞ step. The time offset is clamped to ±largest_time_offset.
  [[nodiscard]] ImuCalibration<Scalar> retracted(ImuCalibration<Scalar> calibration,
                                                 const Eigen::Matrix<Scalar, Rows::count, 1>& step) const {
    calibration.gyro_bias += step.template segment<3>(Rows::gyro_bias);
    calibration.accel_bias += step.template segment<3>(Rows::accel_bias);
    if (options_.estimate_gravity_direction) {
      const Scalar amount = calibration.gravity.norm();
      calibration.gravity += gravity_tangent<Scalar>(calibration.gravity) * step.template segment<2>(Rows::gravity);
      calibration.gravity *= amount / calibration.gravity.norm();
    }
    calibration.mounting.p_BI += step.template segment<3>(Rows::lever_arm);
    if (options_.estimate_time_offset) {
      const double most = options_.largest_time_offset;
      calibration.time_offset =
          std::clamp(calibration.time_offset + static_cast<double>(step[Rows::time_offset]), -most, most);
    }
    return calibration;
  }

  /// Whether each of the unknowns is estimated.
  [[nodiscard]] Eigen::Array<bool, Rows::count, 1> estimated() const {
    Eigen::Array<bool, Rows::count, 1> result;
    result.template segment<3>(Rows::gyro_bias).setConstant(options_.estimate_gyro_bias);
    result.template segment<3>(Rows::accel_bias).setConstant(options_.estimate_accel_bias);
    result.template segment<2>(Rows::gravity).setConstant(options_.estimate_gravity_direction);
    result.template segment<3>(Rows::lever_arm).setConstant(options_.estimate_lever_arm);
    result[Rows::time_offset] = options_.estimate_time_offset;
    return result;
  }

  /// The RMS of the gyro and of the accel residuals, each over its three axes together.
  [[nodiscard]] std::array<Scalar, 2> rms(const Curve& curve, const ImuCalibration<Scalar>& calibration) const {
    using std::sqrt;
    Scalar gyro(0), accel(0);
    for (const auto& sample : samples_) {
      const Time time = std::clamp(after(sample.time, calibration.time_offset), curve.start(), curve.end());
      const auto reading = predicted_imu(curve.template evaluate<2>(time), calibration);
      gyro += (reading.gyro - sample.gyro).squaredNorm();
      accel += (reading.accel - sample.accel).squaredNorm();
    }
    const auto count = static_cast<Scalar>(3 * samples_.size());
    return {sqrt(gyro / count), sqrt(accel / count)};
  }

 private:
  InertialOptions<Scalar> options_;
  std::vector<ImuSample<Scalar, Time>> samples_;
};

}  // namespace splinertia::detail
