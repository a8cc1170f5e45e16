// SPDX-License-Identifier: MIT
/// Residuals of pixels that a camera with a global or rolling shutter has measured from a curve.
#pragma once

#include <ceres/cost_function.h>

#include <splinertia/adapters/detail/ceres_residual.hpp>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/detail/observation_jacobians.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/spline/basis.hpp>
#include <stdexcept>

namespace splinertia {

/// A landmark whose block is its position in the world (3, m).
struct PointLandmark {
  static constexpr int parameters = 3;

  /// The homogeneous point: `point` = w times its position.
  struct Homogeneous {
    Eigen::Vector3d point;
    double w;
  };
  [[nodiscard]] Homogeneous at(const double* block) const { return {Eigen::Map<const Eigen::Vector3d>(block), 1}; }
  /// The derivative of point − w p by the block.
  [[nodiscard]] Eigen::Matrix3d jacobian(const Eigen::Vector3d&) const { return Eigen::Matrix3d::Identity(); }
};

/// A landmark at origin + ray/ρ whose block is the inverse depth ρ (1, per m), e.g. along the ray in which a first frame
/// saw it. ρ = 0 is a point at infinity.
struct InverseDepthLandmark {
  static constexpr int parameters = 1;

  Eigen::Vector3d origin;  ///< in the world, m
  Eigen::Vector3d ray;     ///< in the world, of length 1

  [[nodiscard]] PointLandmark::Homogeneous at(const double* block) const { return {*block * origin + ray, *block}; }
  [[nodiscard]] Eigen::Vector3d jacobian(const Eigen::Vector3d& p) const { return origin - p; }
};

/// r = W (π(T_CW(t) p; θ) − z): the image of a landmark p against a measured pixel z. t is the time at which the row of z
/// is read, in the curve's clock: t = t₀ + τ + rows · d, with the stamp t₀ of the frame, the clock offset τ, the line
/// delay d and `rows` from the row of the stamp to that of z. The camera is at T_WC = T_WB T_BC.
///
/// Blocks, each of which may be constant: the control points; T_BC (SE3, 7); the landmark (3 or 1, see Landmark); τ (s);
/// d (s; constant for a global shutter); the intrinsics θ (Model::parameters()). Give T_BC a CeresManifold, too.
///
/// As in CeresShiftedPoseResidual, the residual belongs to the segment of uniform knots that contains t for τ = 0 and the
/// line delay given here, and the segment's polynomial is extrapolated up to one interval. Evaluate returns false beyond
/// that, for a landmark outside the domain of the model, and for intrinsics that the model refuses.
template <LieGroupWithJacobians G, int Order, CameraModel Model, typename Landmark = PointLandmark>
  requires Pose<G>
class CeresReprojectionResidual final : public detail::CeresResidual<G, Order, 2> {
  using Base = detail::CeresResidual<G, Order, 2>;

 public:
  /// `u` in [0, 1] is the relative position, in its segment of `interval` seconds, of the time at which the row of `pixel`
  /// is read for τ = 0 and d = `line_delay`. W (2 × 2) is the square root of the pixel's information, WᵀW = covariance⁻¹.
  /// Throws std::invalid_argument unless all are finite and the interval positive.
  CeresReprojectionResidual(double u, double interval, double rows, double line_delay, const Eigen::Vector2d& pixel,
                            const Eigen::Matrix2d& square_root_information, const Landmark& landmark = {})
      : Base({7, Landmark::parameters, 1, 1, Model::parameter_count}),
        u_(u),
        interval_(interval),
        rows_(rows),
        line_delay_(line_delay),
        pixel_(pixel),
        weight_(square_root_information),
        landmark_(landmark) {
    const char* const name = "CeresReprojectionResidual";
    detail::require_finite(name, "u", u);
    detail::require_positive(name, "interval", interval);
    detail::require_finite(name, "rows", rows);
    detail::require_finite(name, "line_delay", line_delay);
    detail::require_all_finite(name, "pixel", pixel);
    for (Eigen::Index i = 0; i < 4; ++i) detail::require_finite(name, "square_root_information", weight_.coeff(i));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    double const* const* others = parameters + Base::control_point_blocks;
    const double u = u_ + (*others[2] + rows_ * (*others[3] - line_delay_)) / interval_;
    if (!(u >= -1 && u <= 2)) return false;
    try {
      const Model model = Model::from_parameters(Eigen::Map<const typename Model::Parameters>(others[4]));
      return evaluate_with(model, u, parameters, residuals, jacobians);
    } catch (const std::invalid_argument&) {
      return false;
    }
  }

 private:
  bool evaluate_with(const Model& model, double u, double const* const* parameters, double* residuals,
                     double** jacobians) const {
    double const* const* others = parameters + Base::control_point_blocks;
    const auto points = detail::read_control_points<G, Order>(parameters);
    const auto T_BC = read_parameters<Sophus::SE3d>(others[0]);
    const auto p = landmark_.at(others[1]);
    const auto curve = linearize<1>(typename Base::Span(points), uniform_basis<Order, 1>(u, interval_));
    const Eigen::Matrix3d R_BW = detail::rotation_matrix_transposed<double>(rotation(curve.value).unit_quaternion());
    const Eigen::Matrix3d R_CB = detail::rotation_matrix_transposed<double>(T_BC.unit_quaternion());
    const Eigen::Vector3d p_B = R_BW * (p.point - p.w * position(curve.value));
    const Eigen::Vector3d p_C = R_CB * (p_B - p.w * T_BC.translation());
    const auto image = model.template linearize<Wrt::point | Wrt::parameters>(p_C);
    if (!image) return false;
    Eigen::Map<Eigen::Vector2d>{residuals} = weight_ * (image->pixel - pixel_);
    if (jacobians == nullptr) return true;

    const Eigen::Matrix<double, 2, 3> by_C = weight_ * image->point_jacobian, by_B = by_C * R_CB;
    Eigen::Matrix<double, 2, 6> by_pose;
    if constexpr (SplitPose<G>) {
      by_pose << by_B * detail::hat<double>(p_B), -p.w * by_B * R_BW;
    } else {
      by_pose << -p.w * by_B, by_B * detail::hat<double>(p_B);
    }
    for (std::size_t j = 0; j < points.size(); ++j) {
      Base::write_jacobian(jacobians, j, points[j], by_pose * curve.value_jacobian[j]);
    }
    Eigen::Matrix<double, 2, 6> by_T_BC;
    by_T_BC << -p.w * by_C, by_C * detail::hat<double>(p_C);
    Base::template write_other_jacobian<7>(jacobians, 0,
                                           by_T_BC * ParameterLayout<Sophus::SE3d>::parameters_to_tangent(T_BC));
    Base::template write_other_jacobian<Landmark::parameters>(
        jacobians, 1, by_B * (R_BW * landmark_.jacobian(position(curve.value)) - lever(T_BC)));
    const Eigen::Vector2d rate = by_pose * curve.velocity;
    Base::template write_other_jacobian<1>(jacobians, 2, rate);
    Base::template write_other_jacobian<1>(jacobians, 3, rate * rows_);
    Base::template write_other_jacobian<Model::parameter_count>(jacobians, 4, weight_ * image->parameter_jacobian);
    return true;
  }
  // The derivative of w p_BC by the landmark's block: only inverse depths have one.
  [[nodiscard]] static Eigen::Matrix<double, 3, Landmark::parameters> lever(const Sophus::SE3d& T_BC) {
    if constexpr (Landmark::parameters == 1) {
      return T_BC.translation();
    } else {
      return Eigen::Matrix<double, 3, Landmark::parameters>::Zero();
    }
  }

  double u_, interval_, rows_, line_delay_;
  Eigen::Vector2d pixel_;
  Eigen::Matrix2d weight_;
  Landmark landmark_;
};

}  // namespace splinertia
