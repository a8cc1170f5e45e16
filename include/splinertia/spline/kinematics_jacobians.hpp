// SPDX-License-Identifier: MIT
/// Jacobians of angular rate, angular acceleration and specific force (motion/kinematics.hpp) with respect to the
/// control points of a curve.
#pragma once

#include <cstddef>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/kinematics.hpp>
#include <splinertia/spline/linearize.hpp>

namespace splinertia {

namespace detail {

/// 3 × 6: the Jacobian of a vector with respect to the tangent of one control point.
template <typename Scalar>
using VectorJacobian = Eigen::Matrix<Scalar, 3, 6>;

/// First row of the rotation in the tangent of a pose.
template <Pose G>
inline constexpr int rotation_row = SplitPose<G> ? 0 : 3;

}  // namespace detail

/// Jacobian of ω (body frame) with respect to control point j.
template <Pose G, int Order, int D>
  requires(D >= 1)
[[nodiscard]] detail::VectorJacobian<ScalarOf<G>> angular_velocity_jacobian(const Linearization<G, Order, D>& curve,
                                                                            std::size_t j) {
  return curve.velocity_jacobian[j].template middleRows<3>(detail::rotation_row<G>);
}

/// Jacobian of α (body frame) with respect to control point j.
template <Pose G, int Order>
[[nodiscard]] detail::VectorJacobian<ScalarOf<G>> angular_acceleration_jacobian(const Linearization<G, Order, 2>& curve,
                                                                                std::size_t j) {
  return curve.acceleration_jacobian[j].template middleRows<3>(detail::rotation_row<G>);
}

/// Jacobian of the specific force f (body frame) with respect to control point j. `force` is f, `gravity` (world frame)
/// the g that f was computed with.
///   SO3xR3:  f = Rᵀ(p̈ − g)            df = f^ dφ + Rᵀ dp̈
///   SE3:     f = v̇ + ω × v − Rᵀg      df = dv̇ + ω^ dv − v^ dω − (Rᵀg)^ dφ
template <Pose G, int Order>
[[nodiscard]] detail::VectorJacobian<ScalarOf<G>> specific_force_jacobian(const Linearization<G, Order, 2>& curve,
                                                                          std::size_t j,
                                                                          const Eigen::Vector3<ScalarOf<G>>& force,
                                                                          const Eigen::Vector3<ScalarOf<G>>& gravity) {
  using Scalar = ScalarOf<G>;
  const Jacobian<G>&value = curve.value_jacobian[j], &acceleration = curve.acceleration_jacobian[j];
  const auto& q = rotation(curve.value).unit_quaternion();
  detail::VectorJacobian<Scalar> J;
  if constexpr (SplitPose<G>) {
    J.template leftCols<3>() = detail::hat_times<Scalar>(force, value.template topLeftCorner<3, 3>());
    J.template rightCols<3>() =
        detail::rotation_matrix_transposed<Scalar>(q) * acceleration.template bottomRightCorner<3, 3>();
  } else {
    const Jacobian<G>& velocity = curve.velocity_jacobian[j];
    const Eigen::Vector3<Scalar> v = curve.velocity.template head<3>(), omega = angular_velocity(curve);
    const Eigen::Vector3<Scalar> g_B = detail::rotate_inverse<Scalar>(q, gravity);
    J = acceleration.template topRows<3>() + detail::hat(omega) * velocity.template topRows<3>() -
        detail::hat(v) * velocity.template bottomRows<3>() - detail::hat(g_B) * value.template bottomRows<3>();
  }
  return J;
}

}  // namespace splinertia
