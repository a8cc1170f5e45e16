// SPDX-License-Identifier: MIT
/// SE(3): how exp, log and the Jacobians act on the translation.
///
/// Tangents are τ = [ρ; φ], translation first as in Sophus. SE(3) is SO(3) over the dual numbers φ + ε ρ. Each
/// off-diagonal block below is therefore the directional derivative along ρ of the rotation's function.
#pragma once

#include <splinertia/group/detail/dual_matrix.hpp>
#include <splinertia/group/detail/rotation.hpp>

namespace splinertia::detail {

/// What exp([ρ; φ]) is.
template <typename Scalar>
struct RigidMotionExp {
  Eigen::Quaternion<Scalar> rotation;
  Eigen::Vector3<Scalar> translation;
};

/// exp([ρ; φ]). Its translation is J_l(φ) ρ = c₁ ρ + c₂ φ×ρ + c₃ (φ·ρ) φ. The equal form ρ + c₂ φ×ρ + c₃ φ×(φ×ρ) loses
/// a digit towards π, where ρ and c₃ φ×(φ×ρ) cancel.
template <typename Scalar>
[[nodiscard]] inline RigidMotionExp<Scalar> rigid_motion_exp(const Eigen::Vector3<Scalar>& rho,
                                                             const Eigen::Vector3<Scalar>& phi) {
  const auto c = stumpff<3>(scalar_product<Scalar>(phi, phi));
  const Scalar s = c.half[1] / Constant<Scalar>(2);
  return {{c.half[0], s * phi.x(), s * phi.y(), s * phi.z()},
          c.full[1] * rho + c.full[2] * phi.cross(rho) + (c.full[3] * scalar_product<Scalar>(phi, rho)) * phi};
}

/// The ρ of log(T) for the translation t and the rotation vector φ of T: J_l(φ)⁻¹ t = t − φ×t/2 + E φ×(φ×t).
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector3<Scalar> rigid_motion_log(const Eigen::Vector3<Scalar>& t,
                                                             const Eigen::Vector3<Scalar>& phi) {
  const Scalar E = inverse_jacobian_coefficient(stumpff<3>(Scalar(phi.squaredNorm())));
  const Eigen::Vector3<Scalar> phi_t = phi.cross(t);
  return t - phi_t / Constant<Scalar>(2) + E * phi.cross(phi_t);
}

/// φ^ρ^ + ρ^φ^ = φρᵀ + ρφᵀ − 2(φ·ρ) I, a symmetric matrix.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> hat_anticommutator(const Eigen::Vector3<Scalar>& phi,
                                                               const Eigen::Vector3<Scalar>& rho) {
  Eigen::Matrix3<Scalar> m = phi * rho.transpose() + rho * phi.transpose();
  const Scalar xx = phi.x() * rho.x(), yy = phi.y() * rho.y(), zz = phi.z() * rho.z();
  // The diagonal is summed term by term: subtracting the dot product would cancel.
  m(0, 0) = -Constant<Scalar>(2) * (yy + zz);
  m(1, 1) = -Constant<Scalar>(2) * (xx + zz);
  m(2, 2) = -Constant<Scalar>(2) * (xx + yy);
  return m;
}

/// J_l([ρ; φ]) = [J_l(φ) Q; 0 J_l(φ)] with
///   Q = c₂ ρ^ + c₃ (φ^ρ^ + ρ^φ^) + (φ·ρ)[(2c₄ − c₃) φ^ + (3c₅ − c₄) φ^²].
/// Barfoot (7.85), (7.86), rewritten.
template <typename Scalar>
[[nodiscard]] inline DualMatrix3<Scalar> rigid_motion_left_jacobian(const Eigen::Vector3<Scalar>& rho,
                                                                    const Eigen::Vector3<Scalar>& phi) {
  const auto c = stumpff<5>(Scalar(phi.squaredNorm()));
  const Scalar dot = phi.dot(rho);
  return {hat_polynomial<Scalar>(Scalar(1), c.full[2], c.full[3], phi),
          hat<Scalar>(c.full[2] * rho) + c.full[3] * hat_anticommutator(phi, rho) +
              hat_polynomial<Scalar>(Scalar(0), dot * stumpff_derivative<2>(c), dot * stumpff_derivative<3>(c), phi)};
}

/// J_l([ρ; φ])⁻¹ = [J_l(φ)⁻¹ B; 0 J_l(φ)⁻¹], |φ| < 2π, with
///   B = −ρ^/2 + E (φ^ρ^ + ρ^φ^) + (φ·ρ) (dE/dθ)/θ φ^².
template <typename Scalar>
[[nodiscard]] inline DualMatrix3<Scalar> rigid_motion_left_jacobian_inverse(const Eigen::Vector3<Scalar>& rho,
                                                                            const Eigen::Vector3<Scalar>& phi) {
  const auto c = stumpff<5>(Scalar(phi.squaredNorm()));
  const Scalar E = inverse_jacobian_coefficient(c);
  const Scalar minus_half(Constant<Scalar>(-1) / Constant<Scalar>(2));
  const Scalar slope = phi.dot(rho) * inverse_jacobian_coefficient_derivative(c);
  return {hat_polynomial<Scalar>(Scalar(1), minus_half, E, phi),
          hat<Scalar>(minus_half * rho) + E * hat_anticommutator(phi, rho) +
              hat_polynomial<Scalar>(Scalar(0), Scalar(0), slope, phi)};
}

}  // namespace splinertia::detail
