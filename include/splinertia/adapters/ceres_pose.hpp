// SPDX-License-Identifier: MIT
/// Residuals of a measured value of a curve: a pose (SE3, SO3xR3), an attitude alone (SO3), a position alone (R³).
#pragma once

#include <ceres/cost_function.h>

#include <cmath>
#include <splinertia/adapters/detail/ceres_residual.hpp>
#include <splinertia/spline/basis.hpp>

namespace splinertia {

/// r = W log(Z⁻¹ X): the deviation of the curve's value X from the measured Z, in Z's frame, in tangents of G (SE3
/// [translation; rotation], SO3xR3 [rotation; translation]).
///
///   problem.AddResidualBlock(new CeresPoseResidual<Sophus::SE3d, 4>(basis, T_WB, W), nullptr, T0, T1, T2, T3);
///
/// W (Dof × Dof) is the square root of the measurement's information, WᵀW = covariance⁻¹, so that r has no unit: for
/// standard deviations σ it is the diagonal matrix of 1/σ.
/// Derivative: dr = W J_r⁻¹(log(Z⁻¹ X)) dX, regular up to rotations by π, where log itself jumps.
/// Blocks: the control points.
template <LieGroupWithJacobians G, int Order>
class CeresPoseResidual final : public detail::CeresResidual<G, Order, DofOf<G>> {
  using Base = detail::CeresResidual<G, Order, DofOf<G>>;

 public:
  using Basis = CumulativeBasis<double, Order, 0>;

  /// The basis is that of the curve's knots at the time of the measurement, e.g. UniformKnots::basis(t, n).basis.
  CeresPoseResidual(const Basis& basis, const G& measured, const Jacobian<G>& square_root_information)
      : Base({}), basis_(basis), measured_(measured), weight_(square_root_information) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const auto points = detail::read_control_points<G, Order>(parameters);
    const typename Base::Span span(points);
    Eigen::Map<Tangent<G>> r(residuals);
    if (jacobians == nullptr) {
      r = weight_ * increment<G>(measured_, evaluate<0>(span, basis_).value);
      return true;
    }
    const auto curve = linearize<0>(span, basis_);
    const Tangent<G> error = increment<G>(measured_, curve.value);
    r = weight_ * error;
    const Jacobian<G> slope = weight_ * right_jacobian_inverse<G>(error);
    for (std::size_t j = 0; j < points.size(); ++j) {
      Base::write_jacobian(jacobians, j, points[j], slope * curve.value_jacobian[j]);
    }
    return true;
  }

 private:
  Basis basis_;
  G measured_;
  Jacobian<G> weight_;
};

/// The same for a sensor with a clock offset: its stamp t is time t + τ of the curve. τ (s) is a block after the
/// control points. To estimate the offset between a camera and an IMU, use this residual with one common τ for the
/// camera's poses, and residuals without offset for the IMU's samples.
///
///   r = W log(Z⁻¹ X(t + τ)),   dr/dτ = W J_r⁻¹(log(Z⁻¹ X)) ω     with ω the curve's velocity
///
/// The residual belongs to the segment of uniform knots that contains t. If t + τ leaves it, the segment's polynomial
/// is extrapolated. This keeps r smooth and departs from the curve only as (excess/interval)^(Order − 1). Build the
/// residuals again once τ is known to within an interval. If the excess is more than one interval, Evaluate returns
/// false.
template <LieGroupWithJacobians G, int Order>
class CeresShiftedPoseResidual final : public detail::CeresResidual<G, Order, DofOf<G>> {
  using Base = detail::CeresResidual<G, Order, DofOf<G>>;

 public:
  /// `u` in [0, 1] is the relative position of the stamp in its segment, which is `interval` seconds long.
  CeresShiftedPoseResidual(double u, double interval, const G& measured, const Jacobian<G>& square_root_information)
      : Base({1}), u_(u), interval_(interval), measured_(measured), weight_(square_root_information) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double tau = *parameters[Base::control_point_blocks];
    const double u = u_ + tau / interval_;
    if (!(u >= -1 && u <= 2)) return false;
    const auto points = detail::read_control_points<G, Order>(parameters);
    const typename Base::Span span(points);
    Eigen::Map<Tangent<G>> r(residuals);
    if (jacobians == nullptr) {
      r = weight_ * increment<G>(measured_, evaluate<0>(span, uniform_basis<Order, 0>(u, interval_)).value);
      return true;
    }
    const auto curve = linearize<1>(span, uniform_basis<Order, 1>(u, interval_));
    const Tangent<G> error = increment<G>(measured_, curve.value);
    r = weight_ * error;
    const Jacobian<G> slope = weight_ * right_jacobian_inverse<G>(error);
    for (std::size_t j = 0; j < points.size(); ++j) {
      Base::write_jacobian(jacobians, j, points[j], slope * curve.value_jacobian[j]);
    }
    Base::template write_other_jacobian<1>(jacobians, 0, slope * curve.velocity);
    return true;
  }

 private:
  double u_;
  double interval_;
  G measured_;
  Jacobian<G> weight_;
};

}  // namespace splinertia
