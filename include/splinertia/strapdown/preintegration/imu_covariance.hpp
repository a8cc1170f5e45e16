// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/strapdown/detail/galilean.hpp>
#include <splinertia/strapdown/detail/linearized_increment.hpp>
#include <splinertia/strapdown/preintegration/bias_jacobians.hpp>

namespace splinertia {

/// Densities of the noise of an IMU in continuous time, as WhiteNoise and RandomWalk take them.
template <typename Scalar>
struct ImuNoise {
  Scalar gyro_density;   ///< N, rad/s/√Hz
  Scalar accel_density;  ///< N, m/s²/√Hz
  Scalar gyro_walk;      ///< K, rad/s²/√Hz
  Scalar accel_walk;     ///< K, m/s³/√Hz
};

/// The covariance of a preintegrated motion: of the residual r of preintegration_residual.hpp, attitude (rad), velocity
/// (m/s), position (m), and of what the biases have walked since the beginning, gyro (rad/s), accel (m/s²).
///
/// A sample's white noise is held over its step, N/√h · n, as samples have it; the biases walk between steps. So r
/// after a further part, with its own residual r' and biases that have walked w until it begins, is F r + G (r' + J w),
/// G = diag(I, R, R); the walks add up. Forster et al., IEEE TRO 33 (2017), appendix A, with the biases of the state
/// carried along.
///
/// What it leaves out: schemes that look at both ends of a step share samples between steps, which is the same noise in
/// total but for the ends of a run. A run of n steps of Midpoint has a variance less by 1/(2n) than is said here, and
/// is correlated with the runs before and after it instead; who takes runs of a chain as independent needs what is said
/// here. And it is of first order: an attitude error of size N√t adds |f|N²t²/2 to the velocity along the force f,
/// which must be small beside the accelerometer's noise N'√t.
template <typename Scalar>
class ImuCovariance {
 public:
  using Matrix15 = Eigen::Matrix<Scalar, 15, 15>;

  ImuCovariance() = default;
  /// Of one step.
  ImuCovariance(const LinearizedIncrement<Scalar>& step, const ImuNoise<Scalar>& noise) {
    const Scalar h = step.value.interval;
    Eigen::Matrix<Scalar, 9, 6> B = as_matrix({step.R_w, step.v_w, step.v_f, step.p_w, step.p_f});
    B.template leftCols<3>() *= noise.gyro_density;
    B.template rightCols<3>() *= noise.accel_density;
    motion_ = B * B.transpose() / h;
    gyro_walk_ = noise.gyro_walk * noise.gyro_walk * h;
    accel_walk_ = noise.accel_walk * noise.accel_walk * h;
  }

  /// 15×15, symmetric to the last digit.
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

  /// Adds the covariance `with` of a further part: its motion and its bias Jacobians; R is the attitude at its
  /// beginning.
  void append(const Matrix3<Scalar>& R, const NavIncrement<Scalar>& next, const BiasJacobians<Scalar>& of_next,
              const ImuCovariance& with) {
    // J with the walk's scale, and G from the left.
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

  // G m.
  static void turn(auto& m, const Matrix3<Scalar>& R) {
    m.template middleRows<3>(3) = (R * m.template middleRows<3>(3)).eval();
    m.template middleRows<3>(6) = (R * m.template middleRows<3>(6)).eval();
  }

  Eigen::Matrix<Scalar, 9, 9> motion_ = Eigen::Matrix<Scalar, 9, 9>::Zero();
  Eigen::Matrix<Scalar, 9, 6> cross_ = Eigen::Matrix<Scalar, 9, 6>::Zero();
  Scalar gyro_walk_ = Scalar(0), accel_walk_ = Scalar(0);
};

}  // namespace splinertia
