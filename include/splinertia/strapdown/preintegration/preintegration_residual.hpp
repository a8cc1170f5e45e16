// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/strapdown/nav_state.hpp>
#include <splinertia/strapdown/preintegration/bias_jacobians.hpp>
#include <splinertia/strapdown/preintegration/preintegrated_imu.hpp>

namespace splinertia {

namespace detail {

/// The difference between two states with biases and the preintegrated motion between them, 15 numbers: attitude,
/// velocity, position (the latter two in the body's axes at i), gyro bias, accel bias:
///
///   log(ΔRᵀ R_iᵀ R_j),  R_iᵀ(v_j − v_i − gΔt) − Δv,  R_iᵀ(p_j − p_i − v_iΔt − gΔt²/2) − Δp,  b_j − b_i
///
/// with ΔR, Δv and Δp corrected for b_i. Its covariance is that of the preintegrated motion. Forster et al., IEEE TRO
/// 33 (2017), (45).
template <typename Scalar>
using PreintegrationResidual = Eigen::Matrix<Scalar, 15, 1>;

/// The residual with its derivatives. A state is perturbed by (φ, δv, δp) to R exp(φ^), v + δv, p + δp; biases by
/// (gyro, accel).
template <typename Scalar>
struct LinearizedPreintegrationResidual {
  PreintegrationResidual<Scalar> value;
  Eigen::Matrix<Scalar, 15, 9> state_i, state_j;
  Eigen::Matrix<Scalar, 15, 6> bias_i, bias_j;
};

}  // namespace detail

template <typename Scalar, typename Covariance, TimePoint Time>
[[nodiscard]] detail::PreintegrationResidual<Scalar> preintegration_residual(
    const PreintegratedImu<Scalar, Covariance>& imu, const NavState<Scalar, Time>& i, const ImuBias<Scalar>& bias_i,
    const NavState<Scalar, Time>& j, const ImuBias<Scalar>& bias_j, const Eigen::Vector3<Scalar>& gravity) {
  const detail::NavIncrement<Scalar> delta = imu.corrected(bias_i);
  const auto& q_i = i.R_WB.unit_quaternion();
  const Scalar t = delta.interval;
  detail::PreintegrationResidual<Scalar> r;
  r.template segment<3>(0) =
      detail::rotation_increment<Scalar>(detail::quaternion_product(q_i, delta.rotation), j.R_WB.unit_quaternion());
  r.template segment<3>(3) = detail::rotate_inverse<Scalar>(q_i, j.v_WB - i.v_WB - gravity * t) - delta.velocity;
  r.template segment<3>(6) =
      detail::rotate_inverse<Scalar>(q_i, j.p_WB - i.p_WB - i.v_WB * t - gravity * (t * t / Scalar(2))) -
      delta.position;
  r.template segment<3>(9) = bias_j.gyro - bias_i.gyro;
  r.template segment<3>(12) = bias_j.accel - bias_i.accel;
  return r;
}

template <typename Scalar, typename Covariance, TimePoint Time>
[[nodiscard]] detail::LinearizedPreintegrationResidual<Scalar> linearize_preintegration_residual(
    const PreintegratedImu<Scalar, Covariance>& imu, const NavState<Scalar, Time>& i, const ImuBias<Scalar>& bias_i,
    const NavState<Scalar, Time>& j, const ImuBias<Scalar>& bias_j, const Eigen::Vector3<Scalar>& gravity) {
  detail::LinearizedPreintegrationResidual<Scalar> result;
  result.value = preintegration_residual(imu, i, bias_i, j, bias_j, gravity);
  const Eigen::Matrix3<Scalar> identity = Eigen::Matrix3<Scalar>::Identity();
  const Eigen::Matrix3<Scalar> R_i_transposed = i.R_WB.unit_quaternion().toRotationMatrix().transpose();
  const Eigen::Matrix3<Scalar> R_j_transposed = j.R_WB.unit_quaternion().toRotationMatrix().transpose();
  const Scalar t = imu.delta().interval;
  const detail::BiasJacobians<Scalar>& J = imu.jacobians();
  const Eigen::Vector3<Scalar> r = result.value.template segment<3>(0);
  const Eigen::Matrix3<Scalar> inverse = detail::rotation_left_jacobian_inverse<Scalar>(-r);  // J_r⁻¹(r)
  const Eigen::Vector3<Scalar> turn = J.R_gyro * (bias_i.gyro - imu.bias().gyro);

  result.state_i.setZero();
  result.state_i.template block<3, 3>(0, 0) = -inverse * R_j_transposed * R_i_transposed.transpose();
  const Eigen::Vector3<Scalar> dv = R_i_transposed * (j.v_WB - i.v_WB - gravity * t);
  const Eigen::Vector3<Scalar> dp = R_i_transposed * (j.p_WB - i.p_WB - i.v_WB * t - gravity * (t * t / Scalar(2)));
  result.state_i.template block<3, 3>(3, 0) = detail::hat<Scalar>(dv);
  result.state_i.template block<3, 3>(3, 3) = -R_i_transposed;
  result.state_i.template block<3, 3>(6, 0) = detail::hat<Scalar>(dp);
  result.state_i.template block<3, 3>(6, 3) = -t * R_i_transposed;
  result.state_i.template block<3, 3>(6, 6) = -R_i_transposed;

  result.state_j.setZero();
  result.state_j.template block<3, 3>(0, 0) = inverse;
  result.state_j.template block<3, 3>(3, 3) = R_i_transposed;
  result.state_j.template block<3, 3>(6, 6) = R_i_transposed;

  result.bias_i.setZero();
  // The correction is on the right of ΔR: with E = exp(r), log(exp(−ε) E) = r − J_r⁻¹(r) Eᵀ ε, ε = J_r(turn) R_gyro d.
  result.bias_i.template block<3, 3>(0, 0) = -inverse * detail::rotation_exp<Scalar>(-r).toRotationMatrix() *
                                             detail::rotation_left_jacobian<Scalar>(-turn) * J.R_gyro;
  result.bias_i.template block<3, 3>(3, 0) = -J.v_gyro;
  result.bias_i.template block<3, 3>(3, 3) = -J.v_accel;
  result.bias_i.template block<3, 3>(6, 0) = -J.p_gyro;
  result.bias_i.template block<3, 3>(6, 3) = -J.p_accel;
  result.bias_i.template block<3, 3>(9, 0) = -identity;
  result.bias_i.template block<3, 3>(12, 3) = -identity;

  result.bias_j.setZero();
  result.bias_j.template block<3, 3>(9, 0) = identity;
  result.bias_j.template block<3, 3>(12, 3) = identity;
  return result;
}

}  // namespace splinertia
