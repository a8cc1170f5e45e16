// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/imu/imu_noise.hpp>
#include <splinertia/strapdown/detail/galilean.hpp>
#include <splinertia/strapdown/detail/linearized_increment.hpp>
#include <splinertia/strapdown/preintegration/bias_jacobians.hpp>

namespace splinertia::detail {

/// The covariance of a preintegrated motion, 15×15: of the residual r of preintegration_residual.hpp in attitude (rad),
/// velocity (m/s) and position (m), and of the bias changes since the beginning, gyro (rad/s) and accel (m/s²).
///
/// The white noise of a sample, N/√h · n, is constant over its step. The biases change between steps. Let a further
/// part with residual r' begin after the biases have changed by w. Then the residual of both is F r + G (r' + J w),
/// G = diag(I, R, R), and the bias changes add up. Forster et al., IEEE TRO 33 (2017), appendix A, with the biases as
/// part of the state.
///
/// Two approximations. First, steps are taken as independent, although schemes that use both ends of a step share
/// samples between steps. A run of n steps of Midpoint therefore has a variance smaller by 1/(2n) and is correlated
/// with the neighbouring runs. If you treat runs as independent, this covariance is the right one. Second, it is of
/// first order. An attitude error of size N√t adds |f|N²t²/2 to the velocity along the force f, which must be small
/// beside the accelerometer's noise N'√t.
template <typename Scalar>
class ImuCovariance {
 public:
  using Matrix15 = Eigen::Matrix<Scalar, 15, 15>;

  ImuCovariance() = default;
  /// The covariance of one step.
  ImuCovariance(const LinearizedIncrement<Scalar>& step, const ImuNoise<Scalar>& noise) {
    const Scalar h = step.value.interval;
    Eigen::Matrix<Scalar, 9, 6> B = as_matrix({step.R_w, step.v_w, step.v_f, step.p_w, step.p_f});
    B.template leftCols<3>() *= noise.gyro_density;
    B.template rightCols<3>() *= noise.accel_density;
    motion_ = B * B.transpose() / h;
    gyro_walk_ = noise.gyro_walk * noise.gyro_walk * h;
    accel_walk_ = noise.accel_walk * noise.accel_walk * h;
  }

  /// 15×15, exactly symmetric.
  [[nodiscard]] Matrix15 matrix() const {
    Matrix15 result;
    result.template topLeftCorner<9, 9>() = (motion_ + motion_.transpose()) / Scalar(2);
    result.template topRightCorner<9, 6>() = cross_;
    result.template bottomLeftCorner<6, 9>() = cross_.transpose();
    result.template bottomRightCorner<6, 6>().setZero();
    result.diagonal().template segment<3>(9).setConstant(gyro_walk_);
    result.diagonal().template segment<3>(12).setConstant(accel_walk_);
    return result;
  }

  /// Appends a further part with motion `next`, bias Jacobians `of_next` and covariance `with`. R is the attitude at
  /// its beginning.
  void append(const Eigen::Matrix3<Scalar>& R, const NavIncrement<Scalar>& next, const BiasJacobians<Scalar>& of_next,
              const ImuCovariance& with) {
    // G J, and G J times the covariance of the bias changes.
    Eigen::Matrix<Scalar, 9, 6> GJ = as_matrix(of_next);
    turn(GJ, R);
    Eigen::Matrix<Scalar, 9, 6> GJW = GJ;
    GJW.template leftCols<3>() *= gyro_walk_;
    GJW.template rightCols<3>() *= accel_walk_;

    Eigen::Matrix<Scalar, 9, 9> F = Eigen::Matrix<Scalar, 9, 9>::Identity();
    F.template block<3, 3>(0, 0) = next.rotation.toRotationMatrix().transpose();
    F.template block<3, 3>(3, 0) = -R * hat<Scalar>(next.velocity);
    F.template block<3, 3>(6, 0) = -R * hat<Scalar>(next.position);
    F.template block<3, 3>(6, 3).diagonal().setConstant(next.interval);

    const Eigen::Matrix<Scalar, 9, 6> F_cross = F * cross_;
    const Eigen::Matrix<Scalar, 9, 9> mixed = F_cross * GJ.transpose();
    Eigen::Matrix<Scalar, 9, 9> P = with.motion_;
    turn(P, R);
    P.transposeInPlace();
    turn(P, R);
    motion_ = (F * motion_ * F.transpose() + P + GJW * GJ.transpose() + mixed + mixed.transpose()).eval();

    Eigen::Matrix<Scalar, 9, 6> cross = with.cross_;
    turn(cross, R);
    cross_ = F_cross + GJW + cross;
    gyro_walk_ += with.gyro_walk_;
    accel_walk_ += with.accel_walk_;
  }

 private:
  static Eigen::Matrix<Scalar, 9, 6> as_matrix(const BiasJacobians<Scalar>& J) {
    Eigen::Matrix<Scalar, 9, 6> m;
    m.template block<3, 3>(0, 0) = J.R_gyro;
    m.template block<3, 3>(0, 3).setZero();
    m.template block<3, 3>(3, 0) = J.v_gyro;
    m.template block<3, 3>(3, 3) = J.v_accel;
    m.template block<3, 3>(6, 0) = J.p_gyro;
    m.template block<3, 3>(6, 3) = J.p_accel;
    return m;
  }

  // m becomes G m.
  static void turn(auto& m, const Eigen::Matrix3<Scalar>& R) {
    m.template middleRows<3>(3) = (R * m.template middleRows<3>(3)).eval();
    m.template middleRows<3>(6) = (R * m.template middleRows<3>(6)).eval();
  }

  Eigen::Matrix<Scalar, 9, 9> motion_ = Eigen::Matrix<Scalar, 9, 9>::Zero();
  Eigen::Matrix<Scalar, 9, 6> cross_ = Eigen::Matrix<Scalar, 9, 6>::Zero();
  Scalar gyro_walk_ = Scalar(0), accel_walk_ = Scalar(0);
};

}  // namespace splinertia::detail
