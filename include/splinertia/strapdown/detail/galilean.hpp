// SPDX-License-Identifier: MIT
/// The Lie algebra in which schemes compute. Attitude R, velocity v, position p and time t of a body form the matrix
///
///   X = [ R v p; 0 1 t; 0 0 1 ]
///
/// of the Galilean group SGal(3). Without gravity it obeys X' = X·A, A = [ ω^ f 0; 0 0 1; 0 0 0 ], with the readings ω
/// and f of an ideal IMU. Gravity adds g t and g t²/2, independently of the body's motion.
/// Kelly, "All About the Galilean Group SGal(3)" (2023). SE_2(3) is the same without time: Barrau, Bonnabel, IEEE TRO
/// 36 (2020).
#pragma once

#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/group/detail/stumpff.hpp>

namespace splinertia::detail {

/// [ φ^ ν ρ; 0 0 τ; 0 0 0 ]: φ in rad, ν in m/s, ρ in m, τ in s.
template <typename Scalar>
struct GalileanVector {
  Eigen::Vector3<Scalar> phi, nu, rho;
  Scalar tau;

  [[nodiscard]] GalileanVector operator+(const GalileanVector& other) const {
    return {phi + other.phi, nu + other.nu, rho + other.rho, tau + other.tau};
  }
  [[nodiscard]] GalileanVector operator-(const GalileanVector& other) const {
    return {phi - other.phi, nu - other.nu, rho - other.rho, tau - other.tau};
  }
  [[nodiscard]] GalileanVector operator*(const Scalar& s) const { return {phi * s, nu * s, rho * s, tau * s}; }
};

/// The commutator AB − BA.
template <typename Scalar>
[[nodiscard]] GalileanVector<Scalar> bracket(const GalileanVector<Scalar>& a, const GalileanVector<Scalar>& b) {
  return {a.phi.cross(b.phi), a.phi.cross(b.nu) - b.phi.cross(a.nu),
          a.phi.cross(b.rho) - b.phi.cross(a.rho) + a.nu * b.tau - b.nu * a.tau, Scalar(0)};
}

/// The motion of a body over an interval without gravity, in the body's axes at its beginning.
template <typename Scalar>
struct NavIncrement {
  Eigen::Quaternion<Scalar> rotation;  ///< from the axes at the end to those at the beginning; unit to rounding
  Eigen::Vector3<Scalar> velocity;     ///< m/s
  Eigen::Vector3<Scalar> position;     ///< m
  Scalar interval;                     ///< s
};

/// The left Jacobian of SO(3) times a: J a = a + c₂ φ × a + c₃ φ × (φ × a), with c from stumpff<5>(|φ|²).
template <typename Scalar>
[[nodiscard]] Eigen::Vector3<Scalar> times_left_jacobian(const StumpffValues<Scalar, 5>& c,
                                                         const Eigen::Vector3<Scalar>& phi,
                                                         const Eigen::Vector3<Scalar>& a) {
  const Eigen::Vector3<Scalar> once = phi.cross(a);
  return a + c.full[2] * once + c.full[3] * phi.cross(once);
}

/// exp(φ, ν, 0, τ): R = exp(φ^), v = J ν, p = τ H ν with J = I + c₂ φ^ + c₃ φ^² and H = I/2 + c₃ φ^ + c₄ φ^².
template <typename Scalar>
[[nodiscard]] NavIncrement<Scalar> galilean_exp(const StumpffValues<Scalar, 5>& c, const Eigen::Vector3<Scalar>& phi,
                                                const Eigen::Vector3<Scalar>& nu, const Scalar& tau) {
  const Scalar s = c.half[1] / Constant<Scalar>(2);
  const Eigen::Vector3<Scalar> once = phi.cross(nu), twice = phi.cross(once);
  return {{c.half[0], s * phi.x(), s * phi.y(), s * phi.z()},
          nu + c.full[2] * once + c.full[3] * twice,
          tau * (nu / Constant<Scalar>(2) + c.full[3] * once + c.full[4] * twice),
          tau};
}

/// exp(Ω): as above, with J ρ added to the position.
template <typename Scalar>
[[nodiscard]] NavIncrement<Scalar> galilean_exp(const GalileanVector<Scalar>& omega) {
  const auto c = stumpff<5>(Scalar(omega.phi.squaredNorm()));
  NavIncrement<Scalar> increment = galilean_exp(c, omega.phi, omega.nu, omega.tau);
  increment.position += times_left_jacobian(c, omega.phi, omega.rho);
  return increment;
}

}  // namespace splinertia::detail
