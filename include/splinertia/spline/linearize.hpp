// SPDX-License-Identifier: MIT
/// Value and derivatives of a cumulative B-spline with their Jacobians with respect to the control points, for
/// estimators. One pass, linear in the order.
///
/// All perturbations are on the right. If a control point becomes X_i ⊞ δ = X_i exp(δ), the value becomes X ⊞ (J δ),
/// and velocity and acceleration change by J δ. Derivatives with respect to time are the next members of the motion: if
/// t changes by δt, the value becomes X ⊞ (velocity δt), and the velocity changes by acceleration δt, the acceleration
/// by jerk δt.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/flatten.hpp>
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/product.hpp>
#include <splinertia/motion/motion.hpp>
#include <splinertia/spline/evaluate.hpp>

namespace splinertia {

namespace detail {

/// Jacobians (Dof × Dof) with respect to each of the Order control points.
template <LieGroup G, int Order>
using ControlPointJacobians = std::array<Jacobian<G>, static_cast<std::size_t>(Order)>;

template <LieGroup G, int Order, bool exists>
struct VelocityJacobians {};
template <LieGroup G, int Order>
struct VelocityJacobians<G, Order, true> {
  ControlPointJacobians<G, Order> velocity_jacobian;
};

template <LieGroup G, int Order, bool exists>
struct AccelerationJacobians {};
template <LieGroup G, int Order>
struct AccelerationJacobians<G, Order, true> {
  ControlPointJacobians<G, Order> acceleration_jacobian;
};

}  // namespace detail

/// A motion and its Jacobians. As in Motion, derivatives that were not requested do not exist.
template <LieGroup G, int Order, int D>
  requires(0 <= D && D <= 2)
struct Linearization : Motion<G, D>,
                       detail::VelocityJacobians<G, Order, (D >= 1)>,
                       detail::AccelerationJacobians<G, Order, (D >= 2)> {
  detail::ControlPointJacobians<G, Order> value_jacobian;
};

namespace detail {

/// Calls f with the Jacobians of the value, then of each derivative up to the D-th, one argument per linearization.
template <int D>
inline void for_each_derivative(const auto& f, auto&... linearizations) {
  f(linearizations.value_jacobian...);
  if constexpr (D >= 1) f(linearizations.velocity_jacobian...);
  if constexpr (D >= 2) f(linearizations.acceleration_jacobian...);
}

/// The type in which Jacobians of G are multiplied: GroupTraits<G>::Operator, by default Jacobian<G>.
template <LieGroup G>
struct OperatorSelector {
  using type = Jacobian<G>;
};
template <LieGroup G>
  requires requires { typename GroupTraits<G>::Operator; }
struct OperatorSelector<G> {
  using type = typename GroupTraits<G>::Operator;
};
template <LieGroup G>
using Operator = typename OperatorSelector<G>::type;

/// ad_a M: the bracket of a with every column of M.
template <LieGroup G>
[[nodiscard]] inline Operator<G> bracket_times(const Tangent<G>& a, const Operator<G>& M) {
  if constexpr (requires { GroupTraits<G>::bracket_times(a, M); }) {
    return GroupTraits<G>::bracket_times(a, M);
  } else {
    Jacobian<G> result;
    for (int i = 0; i < DofOf<G>; ++i) result.col(i) = GroupTraits<G>::bracket(a, M.col(i));
    return result;
  }
}

/// M ad_a.
template <LieGroup G>
[[nodiscard]] inline Operator<G> times_bracket(const Operator<G>& M, const Tangent<G>& a) {
  if constexpr (requires { GroupTraits<G>::times_bracket(M, a); }) {
    return GroupTraits<G>::times_bracket(M, a);
  } else {
    return M * bracket_times<G>(a, Jacobian<G>::Identity());
  }
}

/// Ad_{x⁻¹}.
template <LieGroup G>
[[nodiscard]] inline Operator<G> adjoint_inverse_operator(const G& x) {
  if constexpr (requires { GroupTraits<G>::adjoint_inverse_operator(x); }) {
    return GroupTraits<G>::adjoint_inverse_operator(x);
  } else {
    Jacobian<G> m;
    for (int i = 0; i < DofOf<G>; ++i) m.col(i) = adjoint_inverse<G>(x, Tangent<G>::Unit(i));
    return m;
  }
}

/// The identity as an Operator.
template <LieGroup G>
[[nodiscard]] inline Operator<G> identity_operator() {
  if constexpr (requires { Operator<G>::identity(); }) {
    return Operator<G>::identity();
  } else {
    return Operator<G>::Identity();
  }
}

/// The motion and its Jacobians from the first control point and the increments, as evaluate_increments(). Allocates
/// nothing.
///
/// First, each derivative is differentiated with respect to the increments d_j, in the frame of the result:
///   value         D_j = λ_j Π_j J_r(λ_j d_j),                  Π_j = Ad((A_{j+1} … A_{k−1})⁻¹)
///   velocity      W_j = [ω̃_{j−1}, D_j] + λ̇_j Π_j
///   acceleration  A_j = [α̃_{j−1}, D_j] + λ̇_j [ω̃_j, Π_j] + λ̈_j Π_j − [s_{j−1}, W_j]
/// Here s_j and s'_j are the velocity and acceleration of the factors after the j-th, ω̃_j = ω − s_j and
/// α̃_j = α − s'_j − [ω̃_j, s_j]. Then the chain rule gives the Jacobians with respect to the control points: δ at X_j
/// changes d_j by J_r⁻¹(d_j) δ, and δ at X_{j−1} changes it by −J_l⁻¹(d_j) δ, where J_r⁻¹(d) = J_l⁻¹(d) + ad_d.
/// Sommer et al., CVPR 2020, section 5, for any group.
template <int D, LieGroupWithJacobians G, int Order>
[[nodiscard]] inline Linearization<G, Order, D> linearize_pass(const G& first, const auto& d,
                                                               const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  using Traits = GroupTraits<G>;
  using Scalar = ScalarOf<G>;
  constexpr std::size_t factors = Order - 1;
  const auto& lambda = basis.lambda;
  Linearization<G, Order, D> result;
  Motion<G, D>& m = result;
  if constexpr (is_commutative<G>) {
    m = evaluate_increments<D>(first, d, basis);
    std::size_t derivative = 0;
    for_each_derivative<D>(
        [&](auto& jacobians) {
          // B_i = λ_i − λ_{i+1}, with λ_0 = 1 (its derivatives 0) and λ_k = 0
          const auto& weights = lambda[derivative];
          Scalar before(derivative == 0 ? 1 : 0);
          for (std::size_t i = 0; i < factors; ++i) {
            jacobians[i] = (before - weights[i]) * Jacobian<G>::Identity();
            before = weights[i];
          }
          jacobians[factors] = before * Jacobian<G>::Identity();
          ++derivative;
        },
        result);
  } else {
    // Product, velocity and acceleration of the factors from j on. There are none for j = Order − 1.
    std::array<G, factors> P;
    std::array<Tangent<G>, factors + 1> s, s_dot;
    s[factors].setZero();
    m = evaluate_increments<D>(first, d, basis, [&](std::size_t j, const G& product, const Motion<G, D>& sum) {
      P[j] = product;
      if constexpr (D >= 1) s[j] = sum.velocity;
      if constexpr (D >= 2) s_dot[j] = sum.acceleration;
    });
    // through_last[n]: the Jacobian of derivative n by control point j through increment d(j − 1), for j = 0 through
    // the factor X_0. chain() subtracts the part through d(j).
    FixedArray<Operator<G>, D + 1> through_last;
    through_last.fill(Scalar(0) * identity_operator<G>());
    through_last[0] = adjoint_inverse_operator<G>(P[0]);
    std::size_t derivative = 0;
    for (std::size_t j = 0; j < factors; ++j) {
      const Operator<G> behind = j + 1 < factors ? adjoint_inverse_operator<G>(P[j + 1]) : identity_operator<G>();
      const Tangent<G> d_j = d(j);
      const Operator<G> shrink = Traits::left_jacobian_inverse(d_j);
      const auto chain = [&](auto& jacobians, const Operator<G>& X, std::size_t n) {
        const Operator<G> change = X * shrink;
        jacobians[j] = Operator<G>(through_last[n] - change);
        through_last[n] = change + times_bracket<G>(X, d_j);
      };
      const Operator<G> value = lambda[0][j] * (behind * Traits::left_jacobian(Tangent<G>(-lambda[0][j] * d_j)));
      chain(result.value_jacobian, value, 0);
      if constexpr (D >= 1) {
        const Tangent<G> omega_before = m.velocity - s[j];
        const Operator<G> velocity = bracket_times<G>(omega_before, value) + lambda[1][j] * behind;
        chain(result.velocity_jacobian, velocity, 1);
        if constexpr (D >= 2) {
          const Tangent<G> omega_here = lambda[1][j] * (m.velocity - s[j + 1]);
          const Tangent<G> alpha_before = m.acceleration - s_dot[j] - Traits::bracket(omega_before, s[j]);
          const Operator<G> acceleration = bracket_times<G>(alpha_before, value) +
                                           bracket_times<G>(omega_here, behind) + lambda[2][j] * behind -
                                           bracket_times<G>(s[j], velocity);
          chain(result.acceleration_jacobian, acceleration, 2);
        }
      }
    }
    for_each_derivative<D>([&](auto& jacobians) { jacobians[factors] = through_last[derivative++]; }, result);
  }
  return result;
}

/// linearize_pass() with all calls inlined (detail/flatten.hpp).
template <int D, LieGroupWithJacobians G, int Order>
[[nodiscard]] inline Linearization<G, Order, D> linearize_increments(
    const G& first, const auto& d, const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  return flattened<ScalarOf<G>>([&] { return linearize_pass<D>(first, d, basis); });
}

/// On a product each factor is linearized separately: the Jacobians are block-diagonal.
template <int D, LieGroupWithJacobians... F, int Order>
[[nodiscard]] inline Linearization<Product<F...>, Order, D> linearize_increments(
    const Product<F...>& first, const auto& d, const CumulativeBasis<ScalarOf<Product<F...>>, Order, D>& basis) {
  using G = Product<F...>;
  Linearization<G, Order, D> result;
  for_each_derivative<D>(
      [](auto& jacobians) {
        for (auto& J : jacobians) J.setZero();
      },
      result);
  for_each_factor<G>([&]<std::size_t Index, typename Factor>() {
    constexpr int offset = G::template offset<Index>;
    constexpr int dof = DofOf<Factor>;
    const auto part = [&](std::size_t j) { return Tangent<Factor>(d(j).template segment<dof>(offset)); };
    const Linearization<Factor, Order, D> f = linearize_increments<D>(first.template get<Index>(), part, basis);
    result.value.template get<Index>() = f.value;
    if constexpr (D >= 1) result.velocity.template segment<dof>(offset) = f.velocity;
    if constexpr (D >= 2) result.acceleration.template segment<dof>(offset) = f.acceleration;
    for_each_derivative<D>(
        [](auto& whole, const auto& own) {
          for (std::size_t i = 0; i < own.size(); ++i) whole[i].template block<dof, dof>(offset, offset) = own[i];
        },
        result, f);
  });
  return result;
}

}  // namespace detail

/// The motion and its Jacobians from Order control points and the basis, as evaluate().
template <int D, LieGroupWithJacobians G, int Order>
[[nodiscard]] inline Linearization<G, Order, D> linearize(
    std::span<const G, static_cast<std::size_t>(Order)> control_points,
    const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  const auto increments = detail::increments_between<G, Order>(control_points);
  return detail::linearize_increments<D>(
      control_points[0], [&](std::size_t j) -> const Tangent<G>& { return increments[j]; }, basis);
}

/// The same from a span of run-time size. Throws std::invalid_argument unless it has Order control points.
template <int D, LieGroupWithJacobians G, int Order>
[[nodiscard]] inline Linearization<G, Order, D> linearize(std::span<const G> control_points,
                                                          const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  return linearize<D>(with_static_extent<Order>(control_points), basis);
}

}  // namespace splinertia
