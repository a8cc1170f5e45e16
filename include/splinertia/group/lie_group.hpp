// SPDX-License-Identifier: MIT
/// The requirements on a Lie group. A type becomes a group by specialising GroupTraits; the library needs nothing else
/// of it but a default constructor and copies.
///
/// Conventions:
/// - Tangent vectors are columns of Dof scalars; exp and log are the group's exponential coordinates.
/// - Perturbations are on the right: X ⊞ δ = X exp(δ).
/// - Jacobians are those of exp: exp(τ + δ) ≈ exp(J_l(τ) δ) exp(τ) ≈ exp(τ) exp(J_r(τ) δ).
///
/// Notation as in Solà, Deray, Atchuthan, "A micro Lie theory for state estimation in robotics", arXiv:1812.01537.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <Eigen/Core>
#include <concepts>

namespace splinertia {

/// Customisation point. Specialise it for a group G. Required:
///
///   using Scalar                                    the real type
///   static constexpr int Dof                        dimension of the tangent space
///   static G identity()
///   static G compose(const G& x, const G& y)        x y
///   static G inverse(const G& x)                    x⁻¹
///   static G exp(const Tangent& tau)
///   static Tangent log(const G& x)
///   static Tangent adjoint(const G& x, const Tangent& tau)           Ad_x τ = log(x exp(τ) x⁻¹)
///   static Tangent bracket(const Tangent& a, const Tangent& b)       ad_a b = [a, b]
///
/// Optional, for a group that can do better than the defaults:
///
///   static constexpr bool commutative                                X Y = Y X for all X, Y (default: false)
///   static Tangent increment(const G& x, const G& y)                 log(x⁻¹ y), accurate for close x and y
///   static Tangent adjoint_inverse(const G& x, const Tangent& tau)   Ad_{x⁻¹} τ
///   static G exp(const Scalar& lambda, const Tangent& tau)           exp(λ τ), 0 ≤ λ ≤ 1
///
/// Optional, for elements stored as more than Dof numbers, which can drift away from the group:
///
///   static Scalar drift(const G& x)                 how far x is from the group, e.g. ||q| − 1|
///   static G normalized(const G& x)                 the element of the group nearest to x
///
/// Optional, for Jacobians (Dof × Dof):
///
///   static Jacobian left_jacobian(const Tangent& tau)                J_l(τ)
///   static Jacobian left_jacobian_inverse(const Tangent& tau)        J_l(τ)⁻¹, for |rotation| < 2π
///
/// Optional, to linearise a curve at lower cost than with dense Jacobians:
///
///   using Operator = …                              the type that left_jacobian returns (default: Jacobian): has +, −,
///                                                   · by itself and by Scalar, identity(), conversion to Jacobian
///   static Operator adjoint_inverse_operator(const G& x)                 Ad_{x⁻¹}
///   static Operator bracket_times(const Tangent& a, const Operator& M)   ad_a M
///   static Operator times_bracket(const Operator& M, const Tangent& a)   M ad_a
template <typename G>
struct GroupTraits;

template <typename G>
using ScalarOf = typename GroupTraits<G>::Scalar;

template <typename G>
inline constexpr int DofOf = GroupTraits<G>::Dof;

template <typename G>
using Tangent = Eigen::Matrix<ScalarOf<G>, DofOf<G>, 1>;

template <typename G>
using Jacobian = Eigen::Matrix<ScalarOf<G>, DofOf<G>, DofOf<G>>;

// Eigen's own names: an alias of ours would be ambiguous in code that uses both namespaces.

/// A type with a complete GroupTraits. It requires only what evaluating a curve needs.
template <typename G>
concept LieGroup = requires(const G& x, const G& y, const Tangent<G>& a, const Tangent<G>& b) {
  requires std::default_initializable<G>;
  requires GroupTraits<G>::Dof > 0;
  { GroupTraits<G>::identity() } -> std::convertible_to<G>;
  { GroupTraits<G>::compose(x, y) } -> std::convertible_to<G>;
  { GroupTraits<G>::inverse(x) } -> std::convertible_to<G>;
  { GroupTraits<G>::exp(a) } -> std::convertible_to<G>;
  { GroupTraits<G>::log(x) } -> std::convertible_to<Tangent<G>>;
  { GroupTraits<G>::adjoint(x, a) } -> std::convertible_to<Tangent<G>>;
  { GroupTraits<G>::bracket(a, b) } -> std::convertible_to<Tangent<G>>;
};

/// A group that also provides the Jacobians of its exponential.
template <typename G>
concept LieGroupWithJacobians = LieGroup<G> && requires(const Tangent<G>& a) {
  { GroupTraits<G>::left_jacobian(a) } -> std::convertible_to<Jacobian<G>>;
  { GroupTraits<G>::left_jacobian_inverse(a) } -> std::convertible_to<Jacobian<G>>;
};

namespace detail {

/// Whether X Y = Y X. Brackets are then zero and Adjoints the identity, so that neither is ever computed.
template <LieGroup G>
inline constexpr bool is_commutative = [] {
  if constexpr (requires { GroupTraits<G>::commutative; }) {
    return GroupTraits<G>::commutative;
  } else {
    return false;
  }
}();

}  // namespace detail

/// log(x⁻¹ y): the tangent that leads from x to y. Accurate for close x and y if GroupTraits has an increment().
template <LieGroup G>
[[nodiscard]] Tangent<G> increment(const G& x, const G& y) {
  if constexpr (requires { GroupTraits<G>::increment(x, y); }) {
    return GroupTraits<G>::increment(x, y);
  } else {
    return GroupTraits<G>::log(GroupTraits<G>::compose(GroupTraits<G>::inverse(x), y));
  }
}

namespace detail {

/// exp(λ τ) for 0 ≤ λ ≤ 1.
template <LieGroup G>
[[nodiscard]] G exp_of_fraction(const ScalarOf<G>& lambda, const Tangent<G>& tau) {
  if constexpr (requires { GroupTraits<G>::exp(lambda, tau); }) {
    return GroupTraits<G>::exp(lambda, tau);
  } else {
    return GroupTraits<G>::exp(lambda * tau);
  }
}

}  // namespace detail

/// Ad_{x⁻¹} τ: the tangent τ as seen from x.
template <LieGroup G>
[[nodiscard]] Tangent<G> adjoint_inverse(const G& x, const Tangent<G>& tau) {
  if constexpr (requires { GroupTraits<G>::adjoint_inverse(x, tau); }) {
    return GroupTraits<G>::adjoint_inverse(x, tau);
  } else {
    return GroupTraits<G>::adjoint(GroupTraits<G>::inverse(x), tau);
  }
}

/// J_l(τ) of exp on G.
template <LieGroupWithJacobians G>
[[nodiscard]] Jacobian<G> left_jacobian(const Tangent<G>& tau) {
  return GroupTraits<G>::left_jacobian(tau);
}

/// J_r(τ) = J_l(−τ) of exp on G.
template <LieGroupWithJacobians G>
[[nodiscard]] Jacobian<G> right_jacobian(const Tangent<G>& tau) {
  return GroupTraits<G>::left_jacobian(-tau);
}

/// J_l(τ)⁻¹.
template <LieGroupWithJacobians G>
[[nodiscard]] Jacobian<G> left_jacobian_inverse(const Tangent<G>& tau) {
  return GroupTraits<G>::left_jacobian_inverse(tau);
}

/// J_r(τ)⁻¹ = J_l(−τ)⁻¹.
template <LieGroupWithJacobians G>
[[nodiscard]] Jacobian<G> right_jacobian_inverse(const Tangent<G>& tau) {
  return GroupTraits<G>::left_jacobian_inverse(-tau);
}

}  // namespace splinertia
