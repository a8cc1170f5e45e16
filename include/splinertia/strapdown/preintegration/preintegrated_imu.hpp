// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/strapdown/detail/galilean.hpp>
#include <splinertia/strapdown/detail/linearized_increment.hpp>
#include <splinertia/strapdown/nav_state.hpp>
#include <splinertia/strapdown/preintegration/bias_jacobians.hpp>

namespace splinertia {

namespace detail {

/// Placeholder for "no covariance"; adds no member and no cost.
struct NoCovariance {};

}  // namespace detail

/// The motion that an IMU has measured between two times, without gravity and with the biases subtracted. This is
/// preintegration on the manifold, Forster et al., IEEE TRO 33 (2017), but with the motion over each step that the
/// scheme gives. Covariance is NoCovariance or ImuCovariance<Scalar>.
template <typename Scalar, typename Covariance = detail::NoCovariance>
class PreintegratedImu {
 public:
  explicit PreintegratedImu(const ImuBias<Scalar>& bias = {}) : bias_(bias) {
    delta_ = {Eigen::Quaternion<Scalar>::Identity(), Eigen::Vector3<Scalar>::Zero(), Eigen::Vector3<Scalar>::Zero(),
              Scalar(0)};
  }

  /// ΔR, Δv, Δp and Δt.
  [[nodiscard]] const detail::NavIncrement<Scalar>& delta() const { return delta_; }
  [[nodiscard]] const ImuBias<Scalar>& bias() const { return bias_; }
  [[nodiscard]] const detail::BiasJacobians<Scalar>& jacobians() const { return jacobians_; }
  [[nodiscard]] const Covariance& covariance() const { return covariance_; }

  /// The motion for other biases, to first order in their difference from bias().
  [[nodiscard]] detail::NavIncrement<Scalar> corrected(const ImuBias<Scalar>& bias) const {
    const Eigen::Vector3<Scalar> dg = bias.gyro - bias_.gyro, da = bias.accel - bias_.accel;
    const Eigen::Vector3<Scalar> turn = jacobians_.R_gyro * dg;
    return {detail::quaternion_product(delta_.rotation, detail::rotation_exp<Scalar>(turn)),
            delta_.velocity + jacobians_.v_gyro * dg + jacobians_.v_accel * da,
            delta_.position + jacobians_.p_gyro * dg + jacobians_.p_accel * da, delta_.interval};
  }

  /// Appends a step and its covariance.
  void append(const detail::LinearizedIncrement<Scalar>& step, const Covariance& of_step = {}) {
    // Minus, because biases are subtracted from readings.
    append(step.value, {-step.R_w, -step.v_w, -step.v_f, -step.p_w, -step.p_f}, of_step);
  }

  /// Appends the motion that follows this one. If its biases differ, it is corrected to first order in the difference.
  void append(const PreintegratedImu& next) { append(next.corrected(bias_), next.jacobians_, next.covariance_); }

 private:
  void append(const detail::NavIncrement<Scalar>& next, const detail::BiasJacobians<Scalar>& of_next,
              const Covariance& with) {
    const Eigen::Matrix3<Scalar> R = delta_.rotation.toRotationMatrix();
    const Eigen::Matrix3<Scalar> R_next = next.rotation.toRotationMatrix();
    if constexpr (requires { covariance_.append(R, next, of_next, with); }) covariance_.append(R, next, of_next, with);

    detail::BiasJacobians<Scalar>& J = jacobians_;
    // In this order each update still sees the old values that it needs.
    J.p_gyro += J.v_gyro * next.interval + R * (of_next.p_gyro - detail::hat<Scalar>(next.position) * J.R_gyro);
    J.p_accel += J.v_accel * next.interval + R * of_next.p_accel;
    J.v_gyro += R * (of_next.v_gyro - detail::hat<Scalar>(next.velocity) * J.R_gyro);
    J.v_accel += R * of_next.v_accel;
    J.R_gyro = (R_next.transpose() * J.R_gyro + of_next.R_gyro).eval();

    delta_.position += delta_.velocity * next.interval + R * next.position;
    delta_.velocity += R * next.velocity;
    delta_.rotation = detail::advance_attitude<Scalar>(delta_.rotation, next.rotation).unit_quaternion();
    delta_.interval += next.interval;
  }

  detail::NavIncrement<Scalar> delta_;
  detail::BiasJacobians<Scalar> jacobians_;
  ImuBias<Scalar> bias_;
  [[no_unique_address]] Covariance covariance_{};
};

}  // namespace splinertia
