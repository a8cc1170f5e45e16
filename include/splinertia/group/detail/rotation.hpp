// SPDX-License-Identifier: MIT
/// SO(3) on unit quaternions and rotation vectors: the functions behind the groups SO3 and SE3 of sophus.hpp.
///
/// Quaternions are Hamilton's; q and −q are the same rotation. φ is a rotation vector in radians, φ^ its cross product
/// matrix. Only the logarithm has a small-angle branch; the other functions use group/detail/stumpff.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/group/detail/stumpff.hpp>
#include <splinertia/group/lie_group.hpp>

namespace splinertia::detail {

/// exp(φ) as a quaternion (sin(θ/2) φ/θ, cos(θ/2)). Of unit length up to rounding; not normalised.
template <typename Scalar>
[[nodiscard]] inline Eigen::Quaternion<Scalar> rotation_exp(const Eigen::Vector3<Scalar>& phi) {
  const auto h = stumpff<1>(Scalar(phi.squaredNorm())).half;
  const Scalar s = h[1] / Constant<Scalar>(2);
  return {h[0], s * phi.x(), s * phi.y(), s * phi.z()};
}

/// a·b, summed in the order x, y, z for every scalar. (The order in Eigen depends on its SIMD packets.)
template <typename Scalar>
[[nodiscard]] inline Scalar scalar_product(const Eigen::Vector3<Scalar>& a, const Eigen::Vector3<Scalar>& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// exp(λ φ). What does not depend on λ is computed separately, so that a compiler can do it once for many λ.
template <typename Scalar>
[[nodiscard]] inline Eigen::Quaternion<Scalar> rotation_exp(const Scalar& lambda, const Eigen::Vector3<Scalar>& phi) {
  const Scalar theta2 = scalar_product<Scalar>(phi, phi);
  const auto h = stumpff<1>(Scalar(lambda * lambda * theta2)).half;
  const Scalar s = h[1] * (lambda / Constant<Scalar>(2));
  return {h[0], s * phi.x(), s * phi.y(), s * phi.z()};
}

/// The rotation vector φ = v 2 atan2(|v|, w)/|v|, |φ| ≤ π, of the quaternion (v, w) with w ≥ 0 and any length. At w = 0
/// (a rotation by π) the sign of v is kept. NaN for a quaternion that is zero or not finite.
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector3<Scalar> rotation_log_folded(const Eigen::Vector3<Scalar>& v, const Scalar& w) {
  using Real = Constant<Scalar>;
  using std::atan2, std::sqrt;
  const Scalar n2 = v.squaredNorm();
  if (n2 < std::numeric_limits<Real>::epsilon() * w * w) {
    // Two terms of the arc tangent's series; the next is (2/5)(|v|/w)⁴ < eps². Also correct where n2 underflows.
    return v * Scalar((Real(2) - Real(2) / Real(3) * n2 / (w * w)) / w);
  }
  using Limits = std::numeric_limits<Real>;
  if (!(n2 >= (Limits::min)() / Limits::epsilon() && n2 <= (Limits::max)())) [[unlikely]] {
    // |v|² overflows or is too small for full accuracy, and w is not large beside |v|. Divide by the largest component
    // first.
    using std::abs;
    Scalar largest = w;
    for (int i = 0; i < 3; ++i) largest = (std::max)(largest, Scalar(abs(v[i])));
    if (n2 >= Real(0) && largest > Real(0) && largest <= (Limits::max)()) {
      return rotation_log_folded<Scalar>(v / largest, Scalar(w / largest));
    }
    return Eigen::Vector3<Scalar>::Constant(Scalar(Limits::quiet_NaN()));
  }
  const Scalar n = sqrt(n2);
  return v * Scalar(Real(2) * atan2(n, w) / n);
}

/// The rotation vector, |φ| ≤ π, of a quaternion of any finite non-zero length. The relative error is below 2 eps
/// everywhere.
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector3<Scalar> rotation_log(const Eigen::Quaternion<Scalar>& q) {
  if (q.w() < Constant<Scalar>(0)) return rotation_log_folded<Scalar>(-q.vec(), -q.w());
  return rotation_log_folded<Scalar>(q.vec(), q.w());
}

/// log(a⁻¹ b), computed from a and b − a. The difference is exact for close a and b (Sterbenz), so the relative error
/// stays at eps however small the rotation between them is. Equal quaternions give exactly zero.
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector3<Scalar> rotation_increment(const Eigen::Quaternion<Scalar>& a,
                                                               const Eigen::Quaternion<Scalar>& b) {
  const Scalar dot = a.dot(b);
  const bool flip = dot < Constant<Scalar>(0);
  const Eigen::Vector3<Scalar> b_vec = flip ? Eigen::Vector3<Scalar>(-b.vec()) : Eigen::Vector3<Scalar>(b.vec());
  const Scalar b_w = flip ? Scalar(-b.w()) : b.w();
  const Eigen::Vector3<Scalar> d = b_vec - a.vec();
  const Scalar d_w = b_w - a.w();
  const Eigen::Vector3<Scalar> v = a.w() * d - d_w * a.vec() - a.vec().cross(d);
  return rotation_log_folded<Scalar>(v, flip ? Scalar(-dot) : dot);
}

/// The product of quaternions, component by component: Eigen's goes through memory even for values in registers.
template <typename Scalar>
[[nodiscard]] inline Eigen::Quaternion<Scalar> quaternion_product(const Eigen::Quaternion<Scalar>& a,
                                                                  const Eigen::Quaternion<Scalar>& b) {
  return {a.w() * b.w() - a.x() * b.x() - a.y() * b.y() - a.z() * b.z(),
          a.w() * b.x() + a.x() * b.w() + a.y() * b.z() - a.z() * b.y(),
          a.w() * b.y() + a.y() * b.w() + a.z() * b.x() - a.x() * b.z(),
          a.w() * b.z() + a.z() * b.w() + a.x() * b.y() - a.y() * b.x()};
}

/// R v for the unit quaternion q of R: v + w t + u × t with t = 2 u × v.
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector3<Scalar> rotate(const Eigen::Quaternion<Scalar>& q,
                                                   const Eigen::Vector3<Scalar>& v) {
  const Scalar ux = q.x() + q.x(), uy = q.y() + q.y(), uz = q.z() + q.z();
  const Scalar tx = uy * v.z() - uz * v.y(), ty = uz * v.x() - ux * v.z(), tz = ux * v.y() - uy * v.x();
  return {v.x() + q.w() * tx + (q.y() * tz - q.z() * ty), v.y() + q.w() * ty + (q.z() * tx - q.x() * tz),
          v.z() + q.w() * tz + (q.x() * ty - q.y() * tx)};
}

/// Rᵀ v for the unit quaternion q of R.
template <typename Scalar>
[[nodiscard]] inline Eigen::Vector3<Scalar> rotate_inverse(const Eigen::Quaternion<Scalar>& q,
                                                           const Eigen::Vector3<Scalar>& v) {
  const Scalar ux = q.x() + q.x(), uy = q.y() + q.y(), uz = q.z() + q.z();
  const Scalar tx = uz * v.y() - uy * v.z(), ty = ux * v.z() - uz * v.x(), tz = uy * v.x() - ux * v.y();
  return {v.x() + q.w() * tx + (q.z() * ty - q.y() * tz), v.y() + q.w() * ty + (q.x() * tz - q.z() * tx),
          v.z() + q.w() * tz + (q.y() * tx - q.x() * ty)};
}

/// φ^, the matrix with φ^ v = φ × v.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> hat(const Eigen::Vector3<Scalar>& phi) {
  const Scalar zero(0);
  Eigen::Matrix3<Scalar> m;
  m << zero, -phi.z(), phi.y(), phi.z(), zero, -phi.x(), -phi.y(), phi.x(), zero;
  return m;
}

/// Rᵀ for the unit quaternion q of R.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> rotation_matrix_transposed(const Eigen::Quaternion<Scalar>& q) {
  const Scalar x = q.x() + q.x(), y = q.y() + q.y(), z = q.z() + q.z();
  const Scalar xx = x * q.x(), yy = y * q.y(), zz = z * q.z();
  const Scalar xy = x * q.y(), xz = x * q.z(), yz = y * q.z();
  const Scalar wx = x * q.w(), wy = y * q.w(), wz = z * q.w();
  const Scalar one(1);
  Eigen::Matrix3<Scalar> m;
  m << one - (yy + zz), xy + wz, xz - wy,  //
      xy - wz, one - (xx + zz), yz + wx,   //
      xz + wy, yz - wx, one - (xx + yy);
  return m;
}

/// M φ^: each row is the cross product of that row of M with φ.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> times_hat(const Eigen::Matrix3<Scalar>& M,
                                                      const Eigen::Vector3<Scalar>& phi) {
  Eigen::Matrix3<Scalar> m;
  m.col(0) = M.col(1) * phi.z() - M.col(2) * phi.y();
  m.col(1) = M.col(2) * phi.x() - M.col(0) * phi.z();
  m.col(2) = M.col(0) * phi.y() - M.col(1) * phi.x();
  return m;
}

/// φ^ M: each column is the cross product of φ with that column of M.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> hat_times(const Eigen::Vector3<Scalar>& phi,
                                                      const Eigen::Matrix3<Scalar>& M) {
  Eigen::Matrix3<Scalar> m;
  for (int i = 0; i < 3; ++i) {
    m(0, i) = phi.y() * M(2, i) - phi.z() * M(1, i);
    m(1, i) = phi.z() * M(0, i) - phi.x() * M(2, i);
    m(2, i) = phi.x() * M(1, i) - phi.y() * M(0, i);
  }
  return m;
}

/// c I + a φ^ + b φ^², the form of every Jacobian of SO(3).
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> hat_polynomial(const Scalar& c, const Scalar& a, const Scalar& b,
                                                           const Eigen::Vector3<Scalar>& phi) {
  const Eigen::Vector3<Scalar> s = b * phi;
  const Eigen::Vector3<Scalar> t = a * phi;
  const Scalar xy = s.x() * phi.y(), xz = s.x() * phi.z(), yz = s.y() * phi.z();
  const Scalar xx = s.x() * phi.x(), yy = s.y() * phi.y(), zz = s.z() * phi.z();
  Eigen::Matrix3<Scalar> m;
  m << c - (yy + zz), xy - t.z(), xz + t.y(),  //
      xy + t.z(), c - (xx + zz), yz - t.x(),   //
      xz - t.y(), yz + t.x(), c - (xx + yy);
  return m;
}

/// J_l(φ) = I + c₂ φ^ + c₃ φ^². Barfoot, State Estimation for Robotics (2017), (7.77).
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> rotation_left_jacobian(const Eigen::Vector3<Scalar>& phi) {
  const auto c = stumpff<3>(Scalar(phi.squaredNorm())).full;
  return hat_polynomial<Scalar>(Scalar(1), c[2], c[3], phi);
}

/// J_l(φ)⁻¹ = I − φ^/2 + E φ^², |φ| < 2π. Barfoot (7.76), with E in a form that stays accurate at π.
template <typename Scalar>
[[nodiscard]] inline Eigen::Matrix3<Scalar> rotation_left_jacobian_inverse(const Eigen::Vector3<Scalar>& phi) {
  const Scalar E = inverse_jacobian_coefficient(stumpff<3>(Scalar(phi.squaredNorm())));
  return hat_polynomial<Scalar>(Scalar(1), Scalar(Constant<Scalar>(-1) / Constant<Scalar>(2)), E, phi);
}

}  // namespace splinertia::detail
