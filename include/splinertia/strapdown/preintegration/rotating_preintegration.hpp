// SPDX-License-Identifier: MIT
/// Preintegration in a rotating world: the residual of preintegration_residual.hpp with a RotatingFrame as its last
/// argument. Without that argument there is no cost.
///
/// The preintegrated motion does not depend on the world. In a rotating one, state j differs from the inertial formulas
/// by Exp(−Ω Δt) in attitude, c_v in velocity and c_p in position (rotating_frame.hpp, over the whole interval). The
/// residual is the inertial one after these have been removed from state j. This is of first order in |Ω| Δt: on Earth
/// it neglects 1e-9 of the motion after a second.
#pragma once

#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/strapdown/preintegration/preintegration_residual.hpp>
#include <splinertia/strapdown/rotating_frame.hpp>

namespace splinertia {

namespace detail {

/// State j without the effect of the world's rotation since state i.
template <typename Scalar, TimePoint Time>
[[nodiscard]] NavState<Scalar, Time> without_rotation(const NavState<Scalar, Time>& j, const NavState<Scalar, Time>& i,
                                                      const NavIncrement<Scalar>& delta,
                                                      const Eigen::Vector3<Scalar>& gravity,
                                                      const RotatingFrame<Scalar>& frame) {
  const NavState<Scalar, Time> turning = frame.advance(i, delta, gravity, j.time);
  const NavState<Scalar, Time> inertial = InertialFrame{}.advance(i, delta, gravity, j.time);
  return {advance_attitude<Scalar>(rotation_exp<Scalar>(frame.rate * delta.interval), j.R_WB.unit_quaternion()),
          j.v_WB - (turning.v_WB - inertial.v_WB), j.p_WB - (turning.p_WB - inertial.p_WB), j.time};
}

}  // namespace detail

template <typename Scalar, typename Covariance, TimePoint Time>
[[nodiscard]] detail::PreintegrationResidual<Scalar> preintegration_residual(
    const PreintegratedImu<Scalar, Covariance>& imu, const NavState<Scalar, Time>& i, const ImuBias<Scalar>& bias_i,
    const NavState<Scalar, Time>& j, const ImuBias<Scalar>& bias_j, const Eigen::Vector3<Scalar>& gravity,
    const RotatingFrame<Scalar>& frame) {
  return preintegration_residual(imu, i, bias_i, detail::without_rotation(j, i, imu.corrected(bias_i), gravity, frame),
                                 bias_j, gravity);
}

template <typename Scalar, typename Covariance, TimePoint Time>
[[nodiscard]] detail::LinearizedPreintegrationResidual<Scalar> linearize_preintegration_residual(
    const PreintegratedImu<Scalar, Covariance>& imu, const NavState<Scalar, Time>& i, const ImuBias<Scalar>& bias_i,
    const NavState<Scalar, Time>& j, const ImuBias<Scalar>& bias_j, const Eigen::Vector3<Scalar>& gravity,
    const RotatingFrame<Scalar>& frame) {
  const detail::NavIncrement<Scalar> delta = imu.corrected(bias_i);
  auto result = linearize_preintegration_residual(imu, i, bias_i, detail::without_rotation(j, i, delta, gravity, frame),
                                                  bias_j, gravity);
  // With u = R_i Δv and w = R_i Δp: c_p = −h Ω × (h v_i + w + …), c_v = −Ω × (h u − w + 2 (h v_i + w + c_p + …)).
  // The residual changes by −R_iᵀ times the change of c_p and c_v.
  const Scalar h = delta.interval;
  const Eigen::Matrix3<Scalar> R = i.R_WB.unit_quaternion().toRotationMatrix();
  const Eigen::Matrix3<Scalar> turn = detail::hat<Scalar>(frame.rate), identity = Eigen::Matrix3<Scalar>::Identity();
  const Eigen::Matrix3<Scalar> p_w = -h * turn, p_v = h * p_w;
  const Eigen::Matrix3<Scalar> v_u = -h * turn, v_w = -turn * (identity + Scalar(2) * p_w),
                               v_v = -Scalar(2) * turn * (h * identity + p_v);
  const Eigen::Matrix3<Scalar> u_phi = -R * detail::hat<Scalar>(delta.velocity),
                               w_phi = -R * detail::hat<Scalar>(delta.position);
  const detail::BiasJacobians<Scalar>& J = imu.jacobians();
  const Eigen::Matrix3<Scalar> back = -R.transpose();
  result.state_i.template block<3, 3>(3, 0) += back * (v_u * u_phi + v_w * w_phi);
  result.state_i.template block<3, 3>(3, 3) += back * v_v;
  result.state_i.template block<3, 3>(6, 0) += back * (p_w * w_phi);
  result.state_i.template block<3, 3>(6, 3) += back * p_v;
  result.bias_i.template block<3, 3>(3, 0) += back * (v_u * R * J.v_gyro + v_w * R * J.p_gyro);
  result.bias_i.template block<3, 3>(3, 3) += back * (v_u * R * J.v_accel + v_w * R * J.p_accel);
  result.bias_i.template block<3, 3>(6, 0) += back * (p_w * R * J.p_gyro);
  result.bias_i.template block<3, 3>(6, 3) += back * (p_w * R * J.p_accel);
  return result;
}

}  // namespace splinertia
