// SPDX-License-Identifier: MIT
/// Derivatives of the motion of a step with respect to constant offsets of the rate and the force. Bias Jacobians and
/// the noise of a step are computed from them.
#pragma once

#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/strapdown/schemes/scheme.hpp>

namespace splinertia::detail {

/// A step and its derivatives, all 3×3. With δω added to the rate and δf to the force,
///   ΔR becomes ΔR exp(R_w δω),  Δv becomes Δv + v_w δω + v_f δf,  Δp becomes Δp + p_w δω + p_f δf
template <typename Scalar>
struct LinearizedIncrement {
  NavIncrement<Scalar> value;
  Eigen::Matrix3<Scalar> R_w, v_w, p_w;
  Eigen::Matrix3<Scalar> v_f, p_f;
};

/// The coefficient functions of galilean.hpp: a ↦ constant·a + c_m φ×a + c_n φ×(φ×a) as a matrix, and its derivative
/// with respect to φ.
template <int m, int n, typename Scalar>
struct CrossPolynomial {
  Scalar cm, cn, dm, dn;  // coefficients and (dc/dθ)/θ

  explicit CrossPolynomial(const StumpffValues<Scalar, 5>& c)
      : cm(c.full[m]), cn(c.full[n]), dm(stumpff_derivative<m>(c)), dn(stumpff_derivative<n>(c)) {}

  [[nodiscard]] Eigen::Matrix3<Scalar> matrix(const Scalar& constant, const Eigen::Vector3<Scalar>& phi) const {
    const Eigen::Matrix3<Scalar> phi_hat = hat<Scalar>(phi);
    return constant * Eigen::Matrix3<Scalar>::Identity() + cm * phi_hat + cn * phi_hat * phi_hat;
  }
  [[nodiscard]] Eigen::Matrix3<Scalar> derivative(const Eigen::Vector3<Scalar>& phi,
                                                  const Eigen::Vector3<Scalar>& a) const {
    const Eigen::Vector3<Scalar> once = phi.cross(a);
    const Eigen::Matrix3<Scalar> a_hat = hat<Scalar>(a);
    return -cm * a_hat - cn * (hat<Scalar>(once) + hat<Scalar>(phi) * a_hat) +
           (dm * once + dn * phi.cross(once)) * phi.transpose();
  }
};

template <typename Scalar>
[[nodiscard]] LinearizedIncrement<Scalar> linearize_increment(const StepMoments<Scalar>& m) {
  const GalileanVector<Scalar> omega = magnus4(m);
  const auto c = stumpff<5>(Scalar(omega.phi.squaredNorm()));
  const CrossPolynomial<2, 3, Scalar> J(c);
  const CrossPolynomial<3, 4, Scalar> H(c);
  const Scalar h = m.interval;
  LinearizedIncrement<Scalar> result;
  result.value = galilean_exp(c, omega.phi, omega.nu, h);
  result.value.position += times_left_jacobian(c, omega.phi, omega.rho);

  // Derivatives of Ω's φ and ν: an offset adds h times itself to the integrals and leaves the first moments unchanged.
  const Eigen::Matrix3<Scalar> dphi_w = h * (Eigen::Matrix3<Scalar>::Identity() - hat<Scalar>(m.phi_moment));
  const Eigen::Matrix3<Scalar> dnu_w = -h * hat<Scalar>(m.nu_moment);
  const Eigen::Matrix3<Scalar>& dnu_f = dphi_w;

  const Eigen::Matrix3<Scalar> J_matrix = J.matrix(Scalar(1), omega.phi);
  const Eigen::Matrix3<Scalar> H_matrix = h * H.matrix(Scalar(1) / Scalar(2), omega.phi);
  result.R_w = J_matrix.transpose() * dphi_w;  // J_r(φ) = J_l(−φ) = J_l(φ)ᵀ
  result.v_w = J.derivative(omega.phi, omega.nu) * dphi_w + J_matrix * dnu_w;
  result.v_f = J_matrix * dnu_f;
  result.p_w = (J.derivative(omega.phi, omega.rho) + h * H.derivative(omega.phi, omega.nu)) * dphi_w + H_matrix * dnu_w;
  result.p_f = H_matrix * dnu_f;
  return result;
}

template <typename Scalar>
[[nodiscard]] LinearizedIncrement<Scalar> linearize_increment(const StepMean<Scalar>& m) {
  const auto c = stumpff<5>(Scalar(m.phi.squaredNorm()));
  const CrossPolynomial<2, 3, Scalar> J(c);
  const CrossPolynomial<3, 4, Scalar> H(c);
  const Scalar h = m.interval;
  LinearizedIncrement<Scalar> result;
  result.value = galilean_exp(c, m.phi, m.nu, h);
  const Eigen::Matrix3<Scalar> J_matrix = h * J.matrix(Scalar(1), m.phi);
  result.R_w = J_matrix.transpose();
  result.v_w = h * J.derivative(m.phi, m.nu);
  result.v_f = J_matrix;
  result.p_w = (h * h) * H.derivative(m.phi, m.nu);
  result.p_f = (h * h) * H.matrix(Scalar(1) / Scalar(2), m.phi);
  return result;
}

/// Schemes whose steps can be linearized: those with moments(), and those with linearize() (Euler and Trapezoid).
template <typename Scheme, typename Scalar, typename Window>
concept LinearizableScheme = HasMoments<Scheme, Scalar, Window> || requires(const Window& window) {
  Scheme::template linearize<Scalar>(window, std::size_t{0});
};

template <typename Scheme, typename Scalar, typename Window>
  requires LinearizableScheme<Scheme, Scalar, Window>
[[nodiscard]] LinearizedIncrement<Scalar> linearize_step(const Window& window, std::size_t from) {
  return flattened<Scalar>([&] {
    if constexpr (HasMoments<Scheme, Scalar, Window>) {
      return linearize_increment(Scheme::template moments<Scalar>(window, from));
    } else {
      return Scheme::template linearize<Scalar>(window, from);
    }
  });
}

}  // namespace splinertia::detail
