// SPDX-License-Identifier: MIT
/// SE(2): how exp, log and the Jacobians act on the translation. Tangents are [ρ; θ] (Sophus' order). i ρ = (−ρ_y, ρ_x)
/// is ρ turned by a right angle.
#pragma once

#include <splinertia/group/detail/stumpff.hpp>
#include <splinertia/group/lie_group.hpp>

namespace splinertia::detail {

/// i ρ.
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector2<Scalar> quarter_turn(const Eigen::Vector2<Scalar>& rho) {
  return {-rho.y(), rho.x()};
}

/// exp([ρ; θ]) as a complex number and a translation.
template <typename Scalar>
struct PlanarMotionExp {
  Scalar cosine, sine;
  Eigen::Vector2<Scalar> translation;
};

/// exp([ρ; θ]): the rotation (c₀, θc₁) = (cos θ, sin θ) and the translation c₁ρ + θc₂ iρ. One set of coefficients gives
/// both, at a third of the cost of sine and cosine. Error of cosine and sine: 2 eps. Solà et al. (156), (158).
template <typename Scalar>
[[nodiscard]] inline PlanarMotionExp<Scalar> planar_motion_exp(const Eigen::Vector2<Scalar>& rho, const Scalar& theta) {
  const auto c = stumpff<3>(Scalar(theta * theta)).full;
  const Scalar s = theta * c[2];
  return {c[0], theta * c[1], {c[1] * rho.x() - s * rho.y(), c[1] * rho.y() + s * rho.x()}};
}

/// The ρ of log for the translation t and the angle θ: ρ = (1 − Eθ²) t − (θ/2) it, |θ| < 2π. The inverse of
/// planar_motion_exp().
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector2<Scalar> planar_motion_log(const Eigen::Vector2<Scalar>& t, const Scalar& theta) {
  // 1 − Eθ² = (θ/2) cot(θ/2) cancels towards π; the quotient h₀/h₁ is the same without cancellation.
  const auto h = stumpff<3>(Scalar(theta * theta)).half;
  return h[0] / h[1] * t - theta / Constant<Scalar>(2) * quarter_turn(t);
}

/// J_l([ρ; θ]) = Σ adⁿ/(n + 1)!, with ad = [θ i, −iρ; 0, 0]. Solà et al. (163).
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> planar_motion_left_jacobian(const Eigen::Vector2<Scalar>& rho,
                                                                        const Scalar& theta) {
  const auto c = stumpff<3>(Scalar(theta * theta)).full;
  const Scalar s = theta * c[2];
  const Eigen::Vector2<Scalar> column = theta * c[3] * rho - c[2] * quarter_turn(rho);
  const Scalar zero(0), one(1);
  Eigen::Matrix3<Scalar> m;
  m << c[1], -s, column.x(), s, c[1], column.y(), zero, zero, one;
  return m;
}

/// J_l([ρ; θ])⁻¹ = I − ad/2 + E ad², |θ| < 2π.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> planar_motion_left_jacobian_inverse(const Eigen::Vector2<Scalar>& rho,
                                                                                const Scalar& theta) {
  const auto c = stumpff<3>(Scalar(theta * theta));
  const Scalar E = inverse_jacobian_coefficient(c);
  const Scalar diagonal = c.half[0] / c.half[1];
  const Scalar s = theta / Constant<Scalar>(2);
  const Eigen::Vector2<Scalar> column = quarter_turn(rho) / Constant<Scalar>(2) + E * theta * rho;
  const Scalar zero(0), one(1);
  Eigen::Matrix3<Scalar> m;
  m << diagonal, s, column.x(), -s, diagonal, column.y(), zero, zero, one;
  return m;
}

}  // namespace splinertia::detail
