// SPDX-License-Identifier: MIT
/// Residuals of the samples of an IMU in the body frame. W (3 × 3) is the square root of a sample's information,
/// WᵀW = covariance⁻¹. For white noise of density N, sampled at `rate` Hz, it is I/(N √rate).
#pragma once

#include <ceres/cost_function.h>

#include <splinertia/adapters/detail/ceres_residual.hpp>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/spline/kinematics_jacobians.hpp>

namespace splinertia {

/// r = W (ω + b − z): a gyroscope's reading z, rad/s, against the curve's angular velocity ω and the bias b.
/// G is SE3, or SO3 for the rotations of a curve on SO3xR3.
/// Blocks: the control points, the bias (3, rad/s).
template <LieGroupWithJacobians G, int Order>
  requires(detail::RigidPose<G> || std::same_as<G, Sophus::SO3<double>>)
class CeresGyroscopeResidual final : public detail::CeresResidual<G, Order, 3> {
  using Base = detail::CeresResidual<G, Order, 3>;

 public:
  using Basis = CumulativeBasis<double, Order, 1>;

  /// The basis is that of the curve's knots at the time of the sample, e.g. UniformKnots::basis(t, n).basis.
  CeresGyroscopeResidual(const Basis& basis, const Eigen::Vector3<double>& measured,
                         const Eigen::Matrix3<double>& square_root_information)
      : Base({3}), basis_(basis), measured_(measured), weight_(square_root_information) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const auto points = detail::read_control_points<G, Order>(parameters);
    const typename Base::Span span(points);
    const Eigen::Map<const Eigen::Vector3<double>> bias(parameters[Base::control_point_blocks]);
    const auto write_residual = [&](const Motion<G, 1>& curve) {
      Eigen::Map<Eigen::Vector3<double>>{residuals} =
          weight_ * (curve.velocity.template segment<3>(rotation_row) + bias - measured_);
    };
    if (jacobians == nullptr) {
      write_residual(evaluate<1>(span, basis_));
      return true;
    }
    const auto curve = linearize<1>(span, basis_);
    write_residual(curve);
    for (std::size_t j = 0; j < points.size(); ++j) {
      Base::write_jacobian(jacobians, j, points[j],
                           weight_ * curve.velocity_jacobian[j].template middleRows<3>(rotation_row));
    }
    Base::template write_other_jacobian<3>(jacobians, 0, weight_);
    return true;
  }

 private:
  static constexpr int rotation_row = DofOf<G> - 3;
  Basis basis_;
  Eigen::Vector3<double> measured_;
  Eigen::Matrix3<double> weight_;
};

/// r = W (Rᵀ(p̈ − g) + b − z): an accelerometer's reading z, m/s², against the curve's specific force and the bias b.
/// G is SO3xR3 or SE3.
/// Blocks: the control points, the bias (3, m/s²), the gravity g (3, acceleration of free fall in the world, m/s²). To
/// estimate the direction of g alone, give its block a ceres::SphereManifold<3>; to fix g, hold the block constant.
template <LieGroupWithJacobians G, int Order>
  requires Pose<G>
class CeresAccelerometerResidual final : public detail::CeresResidual<G, Order, 3> {
  using Base = detail::CeresResidual<G, Order, 3>;

 public:
  using Basis = CumulativeBasis<double, Order, 2>;

  /// The basis is that of the curve's knots at the time of the sample, e.g. UniformKnots::basis(t, n).basis.
  CeresAccelerometerResidual(const Basis& basis, const Eigen::Vector3<double>& measured,
                             const Eigen::Matrix3<double>& square_root_information)
      : Base({3, 3}), basis_(basis), measured_(measured), weight_(square_root_information) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const auto points = detail::read_control_points<G, Order>(parameters);
    const typename Base::Span span(points);
    const Eigen::Map<const Eigen::Vector3<double>> bias(parameters[Base::control_point_blocks]);
    const Eigen::Vector3<double> gravity =
        Eigen::Map<const Eigen::Vector3<double>>(parameters[Base::control_point_blocks + 1]);
    const auto write_residual = [&](const Eigen::Vector3<double>& force) {
      Eigen::Map<Eigen::Vector3<double>>{residuals} = weight_ * (force + bias - measured_);
    };
    if (jacobians == nullptr) {
      write_residual(specific_force(evaluate<2>(span, basis_), gravity));
      return true;
    }
    const auto curve = linearize<2>(span, basis_);
    const Eigen::Vector3<double> force = specific_force(curve, gravity);
    write_residual(force);
    const Eigen::Matrix3<double> R_transposed =
        weight_ * detail::rotation_matrix_transposed<double>(rotation(curve.value).unit_quaternion());
    for (std::size_t j = 0; j < points.size(); ++j) {
      Base::write_jacobian(jacobians, j, points[j], weight_ * specific_force_jacobian(curve, j, force, gravity));
    }
    Base::template write_other_jacobian<3>(jacobians, 0, weight_);
    Base::template write_other_jacobian<3>(jacobians, 1, -R_transposed);
    return true;
  }

 private:
  Basis basis_;
  Eigen::Vector3<double> measured_;
  Eigen::Matrix3<double> weight_;
};

}  // namespace splinertia
