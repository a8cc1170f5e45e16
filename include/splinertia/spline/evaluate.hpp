// SPDX-License-Identifier: MIT
/// Value and derivatives of a cumulative B-spline on a Lie group from its control points and basis, without a Spline
/// object: for control points that an optimiser owns.
///
///   X(t) = X_0 A_1 … A_{k−1},  A_j = exp(λ_j d_j),  d_j = log(X_{j−1}⁻¹ X_j)
///
/// Sommer et al., "Efficient Derivative Computation for Cumulative B-Splines on Lie Groups", CVPR 2020, (24)–(31), with
/// the recursion run backwards. With P = A_{j+1} … A_{k−1}, each factor needs Ad_{P⁻¹} of a single tangent vector
/// instead of one per derivative, and one pass gives the value and all derivatives.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/group/detail/for_each_factor.hpp>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/product.hpp>
#include <splinertia/motion/motion.hpp>
#include <splinertia/spline/basis.hpp>
#include <stdexcept>
#include <utility>

namespace splinertia {

namespace detail {

/// The default observer of evaluate_increments(). Does nothing, at no cost.
struct NoObserver {
  void operator()(auto&&...) const {}
};

/// The motion of a curve from its first control point and its increments; d(j) returns d_{j+1}, j = 0 … Order − 2. Time
/// is linear in the order: one exp per increment (a single one on a commutative group) and no logarithm.
///
/// On a non-commutative group, observe(j, P, m) is called for j = Order − 2 … 0 with the product of the factors from j
/// on, P = A_{j+1} … A_{k−1}, and their velocity and acceleration in m.
template <int D, LieGroup G, int Order, typename Observer = NoObserver>
[[nodiscard]] inline Motion<G, D> evaluate_increments(const G& first, const auto& d,
                                                      const CumulativeBasis<ScalarOf<G>, Order, D>& basis,
                                                      [[maybe_unused]] const Observer& observe = {}) {
  using Traits = GroupTraits<G>;
  using Scalar = ScalarOf<G>;
  constexpr std::size_t last = Order - 2;
  const auto& lambda = basis.lambda;
  Motion<G, D> m;
  if constexpr (is_commutative<G>) {
    const auto sum = [&](const auto& weights) {
      Tangent<G> tau = weights[last] * d(last);
      for (std::size_t j = last; j-- > 0;) tau += weights[j] * d(j);
      return tau;
    };
    m.value = Traits::compose(first, Traits::exp(sum(lambda[0])));
    if constexpr (D >= 1) m.velocity = sum(lambda[1]);
    if constexpr (D >= 2) m.acceleration = sum(lambda[2]);
    if constexpr (D >= 3) m.jerk = sum(lambda[3]);
  } else {
    // Sums over the factors after the current one, all in the frame at the end of the chain.
    G P = exp_of_fraction<G>(lambda[0][last], d(last));
    if constexpr (D >= 1) m.velocity = lambda[1][last] * d(last);
    if constexpr (D >= 2) m.acceleration = lambda[2][last] * d(last);
    if constexpr (D >= 3) m.jerk = lambda[3][last] * d(last);
    observe(last, P, m);
    // Unrolled: in a loop, compilers keep the sums in memory and compute even those that are never read.
    const auto factor = [&](std::size_t j) {
      if constexpr (D >= 1) {
        const Tangent<G> seen = adjoint_inverse<G>(P, d(j));
        if constexpr (D >= 2) {
          const Tangent<G> b = Traits::bracket(seen, m.velocity);
          if constexpr (D >= 3) {
            m.jerk += lambda[3][j] * seen + Scalar(2) * lambda[2][j] * b +
                      lambda[1][j] * (Traits::bracket(b, m.velocity) + Traits::bracket(seen, m.acceleration));
          }
          m.acceleration += lambda[2][j] * seen + lambda[1][j] * b;
        }
        m.velocity += lambda[1][j] * seen;
      }
      P = Traits::compose(exp_of_fraction<G>(lambda[0][j], d(j)), P);
      observe(j, P, m);
    };
    [&]<std::size_t... Index>(std::index_sequence<Index...>) {
      (factor(last - 1 - Index), ...);
    }(std::make_index_sequence<last>{});
    m.value = Traits::compose(first, P);
  }
  return m;
}

/// On a product each factor is evaluated separately, so none pays for another's brackets.
template <int D, LieGroup... F, int Order>
[[nodiscard]] inline Motion<Product<F...>, D> evaluate_increments(
    const Product<F...>& first, const auto& d, const CumulativeBasis<ScalarOf<Product<F...>>, Order, D>& basis) {
  using G = Product<F...>;
  Motion<G, D> m;
  for_each_factor<G>([&]<std::size_t Index, typename Factor>() {
    constexpr int offset = G::template offset<Index>;
    constexpr int dof = DofOf<Factor>;
    const auto part = [&](std::size_t j) { return Tangent<Factor>(d(j).template segment<dof>(offset)); };
    const Motion<Factor, D> f = evaluate_increments<D>(first.template get<Index>(), part, basis);
    m.value.template get<Index>() = f.value;
    if constexpr (D >= 1) m.velocity.template segment<dof>(offset) = f.velocity;
    if constexpr (D >= 2) m.acceleration.template segment<dof>(offset) = f.acceleration;
    if constexpr (D >= 3) m.jerk.template segment<dof>(offset) = f.jerk;
  });
  return m;
}

/// d_1 … d_{k−1} between Order successive control points.
template <LieGroup G, int Order>
[[nodiscard]] inline FixedArray<Tangent<G>, Order - 1> increments_between(
    std::span<const G, static_cast<std::size_t>(Order)> control_points) {
  FixedArray<Tangent<G>, Order - 1> d;
  for (std::size_t j = 0; j < d.size(); ++j) d[j] = increment<G>(control_points[j], control_points[j + 1]);
  return d;
}

}  // namespace detail

/// Converts a span of run-time size to one of Order control points. Throws std::invalid_argument for any other size.
template <int Order, LieGroup G>
[[nodiscard]] inline std::span<const G, static_cast<std::size_t>(Order)> with_static_extent(
    std::span<const G> control_points) {
  if (control_points.size() != static_cast<std::size_t>(Order)) {
    detail::refuse<std::invalid_argument>("expected ", Order, " control points (the order of the curve), got ",
                                          control_points.size());
  }
  return control_points.template first<static_cast<std::size_t>(Order)>();
}

/// The motion from the Order control points that determine the curve at a time, and the basis there, e.g. from
/// UniformKnots::basis().
template <int D, LieGroup G, int Order>
[[nodiscard]] inline Motion<G, D> evaluate(std::span<const G, static_cast<std::size_t>(Order)> control_points,
                                           const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  const auto increments = detail::increments_between<G, Order>(control_points);
  return detail::evaluate_increments<D>(
      control_points[0], [&](std::size_t j) -> const Tangent<G>& { return increments[j]; }, basis);
}

/// The same from a span of run-time size. Throws std::invalid_argument unless it has Order control points.
template <int D, LieGroup G, int Order>
[[nodiscard]] inline Motion<G, D> evaluate(std::span<const G> control_points,
                                           const CumulativeBasis<ScalarOf<G>, Order, D>& basis) {
  return evaluate<D>(with_static_extent<Order>(control_points), basis);
}

}  // namespace splinertia
