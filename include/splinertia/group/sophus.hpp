// SPDX-License-Identifier: MIT
/// Sophus' SO2, SO3, SE2 and SE3 as groups. Only the types are Sophus'. exp, log, products and Jacobians are this
/// library's own, because Sophus' lose digits near 0 and near π and renormalise at each product.
///
/// Tangents are in Sophus' order: SE2 [x y θ], SE3 [translation; rotation].
#pragma once

#include <sophus/se2.hpp>
#include <sophus/se3.hpp>
#include <splinertia/group/detail/planar_motion.hpp>
#include <splinertia/group/detail/rigid_motion.hpp>
#include <splinertia/group/detail/rotation.hpp>

namespace splinertia {

/// The Sophus rotation with the quaternion q, which is not normalised (Sophus' own constructor would do so).
template <typename Scalar>
[[nodiscard]] inline Sophus::SO3<Scalar> rotation_from_unit_quaternion(const Eigen::Quaternion<Scalar>& q) {
  Sophus::SO3<Scalar> R;
  R.data()[0] = q.x();
  R.data()[1] = q.y();
  R.data()[2] = q.z();
  R.data()[3] = q.w();
  return R;
}

namespace detail {

/// The Sophus rotation with this complex number, which is not normalised.
template <typename Scalar>
[[nodiscard]] inline Sophus::SO2<Scalar> rotation_from_unit_complex(const Scalar& real, const Scalar& imaginary) {
  Sophus::SO2<Scalar> R;
  R.data()[0] = real;
  R.data()[1] = imaginary;
  return R;
}

/// ||v| − 1|: how far the numbers of a rotation have drifted from unit length.
template <typename Vector>
[[nodiscard]] inline auto distance_from_one(const Vector& v) {
  using std::abs;
  using Scalar = typename Vector::Scalar;
  return Scalar(abs(v.norm() - Scalar(1)));
}

}  // namespace detail

template <typename Real>
struct GroupTraits<Sophus::SO2<Real>> {
  using Scalar = Real;
  using G = Sophus::SO2<Real>;
  using Vector = Eigen::Matrix<Real, 1, 1>;
  static constexpr int Dof = 1;
  static constexpr bool commutative = true;

  static G identity() { return G{}; }
  static G compose(const G& x, const G& y) {
    const auto& a = x.unit_complex();
    const auto& b = y.unit_complex();
    return detail::rotation_from_unit_complex<Real>(a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x());
  }
  static G inverse(const G& x) {
    return detail::rotation_from_unit_complex<Real>(x.unit_complex().x(), -x.unit_complex().y());
  }
  static G exp(const Vector& tau) {
    using std::cos, std::sin;
    return detail::rotation_from_unit_complex<Real>(cos(tau[0]), sin(tau[0]));
  }
  static Vector log(const G& x) {
    using std::atan2;
    return Vector{Real(atan2(x.unit_complex().y(), x.unit_complex().x()))};
  }
  static Vector adjoint(const G&, const Vector& tau) { return tau; }
  static Vector bracket(const Vector&, const Vector&) { return Vector::Zero(); }
  /// The sine is computed from a and b − a; the difference is exact for close a and b.
  static Vector increment(const G& x, const G& y) {
    using std::atan2;
    const auto& a = x.unit_complex();
    const Eigen::Vector2<Real> d = y.unit_complex() - a;
    return Vector{Real(atan2(a.x() * d.y() - a.y() * d.x(), a.dot(y.unit_complex())))};
  }
  static Real drift(const G& x) { return detail::distance_from_one(x.unit_complex()); }
  static G normalized(const G& x) {
    const Eigen::Vector2<Real> z = x.unit_complex().normalized();
    return detail::rotation_from_unit_complex<Real>(z.x(), z.y());
  }
  static Vector left_jacobian(const Vector&) { return Vector::Ones(); }
  static Vector left_jacobian_inverse(const Vector&) { return Vector::Ones(); }
};

template <typename Real>
struct GroupTraits<Sophus::SO3<Real>> {
  using Scalar = Real;
  using G = Sophus::SO3<Real>;
  using Vector = Eigen::Vector3<Real>;
  static constexpr int Dof = 3;

  static G identity() { return G{}; }
  static G compose(const G& x, const G& y) {
    return rotation_from_unit_quaternion<Real>(
        detail::quaternion_product<Real>(x.unit_quaternion(), y.unit_quaternion()));
  }
  static G inverse(const G& x) { return rotation_from_unit_quaternion<Real>(x.unit_quaternion().conjugate()); }
  static G exp(const Vector& tau) { return rotation_from_unit_quaternion<Real>(detail::rotation_exp<Real>(tau)); }
  static G exp(const Real& lambda, const Vector& tau) {
    return rotation_from_unit_quaternion<Real>(detail::rotation_exp<Real>(lambda, tau));
  }
  static Vector log(const G& x) { return detail::rotation_log<Real>(x.unit_quaternion()); }
  static Vector adjoint(const G& x, const Vector& tau) { return detail::rotate<Real>(x.unit_quaternion(), tau); }
  static Vector adjoint_inverse(const G& x, const Vector& tau) {
    return detail::rotate_inverse<Real>(x.unit_quaternion(), tau);
  }
  static Vector bracket(const Vector& a, const Vector& b) { return a.cross(b); }
  static Vector increment(const G& x, const G& y) {
    return detail::rotation_increment<Real>(x.unit_quaternion(), y.unit_quaternion());
  }
  static Real drift(const G& x) { return detail::distance_from_one(x.unit_quaternion().coeffs()); }
  static G normalized(const G& x) { return rotation_from_unit_quaternion<Real>(x.unit_quaternion().normalized()); }
  static Eigen::Matrix3<Real> left_jacobian(const Vector& tau) { return detail::rotation_left_jacobian<Real>(tau); }
  static Eigen::Matrix3<Real> left_jacobian_inverse(const Vector& tau) {
    return detail::rotation_left_jacobian_inverse<Real>(tau);
  }
  static Eigen::Matrix3<Real> adjoint_inverse_operator(const G& x) {
    return detail::rotation_matrix_transposed<Real>(x.unit_quaternion());
  }
  static Eigen::Matrix3<Real> bracket_times(const Vector& a, const Eigen::Matrix3<Real>& M) {
    return detail::hat_times<Real>(a, M);
  }
  static Eigen::Matrix3<Real> times_bracket(const Eigen::Matrix3<Real>& M, const Vector& a) {
    return detail::times_hat<Real>(M, a);
  }
};

template <typename Real>
struct GroupTraits<Sophus::SE2<Real>> {
  using Scalar = Real;
  using G = Sophus::SE2<Real>;
  using SO2 = GroupTraits<Sophus::SO2<Real>>;
  using Vector = Eigen::Vector3<Real>;
  static constexpr int Dof = 3;

  static G identity() { return G{}; }
  static G compose(const G& x, const G& y) {
    return make(SO2::compose(x.so2(), y.so2()), x.translation() + turn(x.so2(), y.translation()));
  }
  static G inverse(const G& x) {
    const auto R_inverse = SO2::inverse(x.so2());
    return make(R_inverse, -turn(R_inverse, x.translation()));
  }
  static G exp(const Vector& tau) {
    const auto x = detail::planar_motion_exp<Real>(tau.template head<2>(), tau[2]);
    return make(detail::rotation_from_unit_complex<Real>(x.cosine, x.sine), x.translation);
  }
  static Vector log(const G& x) { return logarithm(x.translation(), SO2::log(x.so2())[0]); }
  /// Ad_x [ρ; θ] = [Rρ − θ i t; θ]
  static Vector adjoint(const G& x, const Vector& tau) {
    const Eigen::Vector2<Real> rho =
        turn(x.so2(), tau.template head<2>()) - tau[2] * detail::quarter_turn<Real>(x.translation());
    return {rho.x(), rho.y(), tau[2]};
  }
  static Vector adjoint_inverse(const G& x, const Vector& tau) {
    const Eigen::Vector2<Real> rho =
        turn(SO2::inverse(x.so2()), tau.template head<2>() + tau[2] * detail::quarter_turn<Real>(x.translation()));
    return {rho.x(), rho.y(), tau[2]};
  }
  /// [a, b] = [θ_a i ρ_b − θ_b i ρ_a; 0]
  static Vector bracket(const Vector& a, const Vector& b) {
    const Eigen::Vector2<Real> rho =
        detail::quarter_turn<Real>(a[2] * b.template head<2>() - b[2] * a.template head<2>());
    return {rho.x(), rho.y(), Real(0)};
  }
  /// Subtracts the translations in the world, where the difference is exact for close x and y.
  static Vector increment(const G& x, const G& y) {
    return logarithm(turn(SO2::inverse(x.so2()), y.translation() - x.translation()),
                     SO2::increment(x.so2(), y.so2())[0]);
  }
  static Real drift(const G& x) { return SO2::drift(x.so2()); }
  static G normalized(const G& x) { return make(SO2::normalized(x.so2()), x.translation()); }
  static Eigen::Matrix3<Real> left_jacobian(const Vector& tau) {
    return detail::planar_motion_left_jacobian<Real>(tau.template head<2>(), tau[2]);
  }
  static Eigen::Matrix3<Real> left_jacobian_inverse(const Vector& tau) {
    return detail::planar_motion_left_jacobian_inverse<Real>(tau.template head<2>(), tau[2]);
  }

 private:
  static G make(const Sophus::SO2<Real>& R, const Eigen::Vector2<Real>& t) {
    G x;
    x.so2() = R;
    x.translation() = t;
    return x;
  }
  static Eigen::Vector2<Real> turn(const Sophus::SO2<Real>& R, const Eigen::Vector2<Real>& v) {
    return R.unit_complex().x() * v + R.unit_complex().y() * detail::quarter_turn<Real>(v);
  }
  static Vector logarithm(const Eigen::Vector2<Real>& t, const Real& theta) {
    const Eigen::Vector2<Real> rho = detail::planar_motion_log<Real>(t, theta);
    return {rho.x(), rho.y(), theta};
  }
};

template <typename Real>
struct GroupTraits<Sophus::SE3<Real>> {
  using Scalar = Real;
  using G = Sophus::SE3<Real>;
  using Vector = Eigen::Matrix<Real, 6, 1>;
  using Operator = detail::DualMatrix3<Real>;
  static constexpr int Dof = 6;

  static G identity() { return G{}; }
  static G compose(const G& x, const G& y) {
    const auto& q = x.unit_quaternion();
    return make(detail::quaternion_product<Real>(q, y.unit_quaternion()),
                x.translation() + detail::rotate<Real>(q, y.translation()));
  }
  static G inverse(const G& x) {
    const auto& q = x.unit_quaternion();
    return make(q.conjugate(), -detail::rotate_inverse<Real>(q, x.translation()));
  }
  static G exp(const Vector& tau) {
    const auto x = detail::rigid_motion_exp<Real>(tau.template head<3>(), tau.template tail<3>());
    return make(x.rotation, x.translation);
  }
  static Vector log(const G& x) { return logarithm(x.translation(), detail::rotation_log<Real>(x.unit_quaternion())); }
  /// Ad_x [ρ; φ] = [Rρ + t × Rφ; Rφ]
  static Vector adjoint(const G& x, const Vector& tau) {
    const auto& q = x.unit_quaternion();
    const Eigen::Vector3<Real> phi = detail::rotate<Real>(q, tau.template tail<3>());
    return join(detail::rotate<Real>(q, tau.template head<3>()) + x.translation().cross(phi), phi);
  }
  /// Ad_{x⁻¹} [ρ; φ] = [Rᵀ(ρ − t × φ); Rᵀφ]
  static Vector adjoint_inverse(const G& x, const Vector& tau) {
    const auto& q = x.unit_quaternion();
    const Eigen::Vector3<Real> phi = tau.template tail<3>();
    return join(detail::rotate_inverse<Real>(q, tau.template head<3>() - x.translation().cross(phi)),
                detail::rotate_inverse<Real>(q, phi));
  }
  /// [a, b] = [φ_a × ρ_b + ρ_a × φ_b; φ_a × φ_b]
  static Vector bracket(const Vector& a, const Vector& b) {
    const Eigen::Vector3<Real> rho_a = a.template head<3>(), phi_a = a.template tail<3>();
    const Eigen::Vector3<Real> rho_b = b.template head<3>(), phi_b = b.template tail<3>();
    return join(phi_a.cross(rho_b) + rho_a.cross(phi_b), phi_a.cross(phi_b));
  }
  /// Subtracts the translations in the world, where the difference is exact for close x and y, however large they are.
  static Vector increment(const G& x, const G& y) {
    const auto& q = x.unit_quaternion();
    return logarithm(detail::rotate_inverse<Real>(q, y.translation() - x.translation()),
                     detail::rotation_increment<Real>(q, y.unit_quaternion()));
  }
  static Real drift(const G& x) { return detail::distance_from_one(x.unit_quaternion().coeffs()); }
  static G normalized(const G& x) { return make(x.unit_quaternion().normalized(), x.translation()); }
  static Operator left_jacobian(const Vector& tau) {
    return detail::rigid_motion_left_jacobian<Real>(tau.template head<3>(), tau.template tail<3>());
  }
  static Operator left_jacobian_inverse(const Vector& tau) {
    return detail::rigid_motion_left_jacobian_inverse<Real>(tau.template head<3>(), tau.template tail<3>());
  }
  /// [Rᵀ −Rᵀt^; 0 Rᵀ]
  static Operator adjoint_inverse_operator(const G& x) {
    const Eigen::Matrix3<Real> R_transposed = detail::rotation_matrix_transposed<Real>(x.unit_quaternion());
    return {R_transposed, -detail::times_hat<Real>(R_transposed, x.translation())};
  }
  static Operator bracket_times(const Vector& a, const Operator& M) {
    const Eigen::Vector3<Real> rho = a.template head<3>(), phi = a.template tail<3>();
    return {detail::hat_times<Real>(phi, M.real),
            detail::hat_times<Real>(phi, M.dual) + detail::hat_times<Real>(rho, M.real)};
  }
  static Operator times_bracket(const Operator& M, const Vector& a) {
    const Eigen::Vector3<Real> rho = a.template head<3>(), phi = a.template tail<3>();
    return {detail::times_hat<Real>(M.real, phi),
            detail::times_hat<Real>(M.dual, phi) + detail::times_hat<Real>(M.real, rho)};
  }

 private:
  static G make(const Eigen::Quaternion<Real>& q, const Eigen::Vector3<Real>& t) {
    G x;
    x.so3() = rotation_from_unit_quaternion<Real>(q);
    x.translation() = t;
    return x;
  }
  // Element by element: for SIMD packets of a 3-vector, g++ 12 warns of array bounds that are not exceeded.
  static Vector join(const Eigen::Vector3<Real>& rho, const Eigen::Vector3<Real>& phi) {
    Vector tau;
    for (int i = 0; i < 3; ++i) {
      tau[i] = rho[i];
      tau[i + 3] = phi[i];
    }
    return tau;
  }
  static Vector logarithm(const Eigen::Vector3<Real>& t, const Eigen::Vector3<Real>& phi) {
    return join(detail::rigid_motion_log<Real>(t, phi), phi);
  }
};

}  // namespace splinertia
