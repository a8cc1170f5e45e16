// SPDX-License-Identifier: MIT
/// The cumulative basis of arbitrary knots from the 2k − 2 knots around a time, by the De Boor–Cox recursion.
///
///   B_{j,1} = 1 on [τ_j, τ_{j+1}),  Q_{j,m} = B_{j,m} / (τ_{j+m} − τ_j)
///   B_{j,m+1} = (t − τ_j) Q_{j,m} + (τ_{j+m+1} − t) Q_{j+1,m}
///
/// On the span of t every term is positive, so nothing cancels however unequal the spans are. Every support
/// [τ_j, τ_{j+m}] contains the span, so no divisor is zero where knots coincide. The derivatives of the cumulative
/// basis need no sum, and those of Q come from one order below:
///
///   λ_j' = Σ_{l ≥ j} B_l' = (k − 1) Q_{j,k−1},  Q_{j,m}' = (m − 1) (Q_{j,m−1} − Q_{j+1,m−1}) / (τ_{j+m} − τ_j)
///
/// C. de Boor, "A Practical Guide to Splines", 1978, chapter X, (4), (5) and (12); K. Qin, "General matrix
/// representations for B-splines", The Visual Computer 16 (2000), for the cumulative form.
#pragma once

#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/group/detail/stumpff.hpp>
#include <splinertia/spline/basis.hpp>
#include <splinertia/time.hpp>
#include <utility>

namespace splinertia::detail {

/// The units of units_between() per second: 1, or the ticks per second of an integer Time.
template <typename Real, TimePoint Time>
[[nodiscard]] constexpr Real units_per_second() {
  if constexpr (std::floating_point<Time>) {
    return Real(1);
  } else {
    return static_cast<Real>(Time::period::den) / static_cast<Real>(Time::period::num);
  }
}

/// The basis on the span τ_i < τ_{i+1} from the ascending knots τ_{i−k+2} … τ_{i+k−1} (k: Order). `before` holds the
/// times from the k − 1 knots on the left to t, `behind` those from t to the knots on the right, in the units of
/// units_between(). Each is a number, or a SIMD pack for several t in the span.
///
/// The largest error found is 4 eps for the cubic and 6 eps for order 8: relative to 1 for values, to the largest first
/// derivative, and for second and third derivatives, which are differences, to the largest sum of their terms'
/// magnitudes.
template <int Order, int D, typename Scalar, typename U, TimePoint Time>
[[nodiscard]] inline CumulativeBasis<Scalar, Order, D> nonuniform_basis(
    std::span<const Time, static_cast<std::size_t>(2 * Order - 2)> knots,
    const std::array<U, static_cast<std::size_t>(Order - 1)>& before,
    const std::array<U, static_cast<std::size_t>(Order - 1)>& behind) {
  using Real = Constant<Scalar>;
  constexpr std::size_t k = Order;
  assert(knots[k - 2] < knots[k - 1]);
  const Real rate = units_per_second<Real, Time>();

  // B[p] = B_{i−m+1+p,m}, p = 0 … m − 1: the m functions of order m that are not zero on the span. q[d][p] is
  // derivative d of its Q. Each order overwrites the one below.
  std::array<U, k> B{U(Real(1))};
  FixedArray<FixedArray<U, k - 1>, (D > 1 ? D : 1)> q{};
  const auto order = [&]<std::size_t m>() {
    std::array<Real, m> width;
    for (std::size_t p = 0; p < m; ++p) {
      width[p] = units_between<Real>(knots[k - 1 - m + p], knots[k - 1 + p]);
    }
    const Real factor = static_cast<Real>(m - 1) * rate;
    for (std::size_t d = D; d-- > 1;) {
      if (d >= m || d + (k - 1 - m) >= static_cast<std::size_t>(D)) continue;  // zero, or not needed above
      for (std::size_t p = 0; p < m; ++p) {
        const U left = p > 0 ? q[d - 1][p - 1] : U(Real(0));
        const U right = p + 1 < m ? q[d - 1][p] : U(Real(0));
        q[d][p] = factor * (left - right) / width[p];
      }
    }
    for (std::size_t p = 0; p < m; ++p) q[0][p] = B[p] / width[p];
    B[0] = behind[0] * q[0][0];
    for (std::size_t p = 1; p < m; ++p) B[p] = before[k - 2 - m + p] * q[0][p - 1] + behind[p] * q[0][p];
    B[m] = before[k - 2] * q[0][m - 1];
  };
  [&]<std::size_t... M>(std::index_sequence<M...>) {
    (order.template operator()<M + 1>(), ...);
  }(std::make_index_sequence<k - 1>{});

  CumulativeBasis<Scalar, Order, D> basis;
  U sum(Real(0));
  for (std::size_t j = k - 1; j-- > 0;) basis.lambda[0][j] = static_cast<Scalar>(sum += B[j + 1]);
  const Real factor = static_cast<Real>(Order - 1) * rate;
  for (std::size_t d = 1; d <= static_cast<std::size_t>(D); ++d) {
    for (std::size_t j = 0; j < k - 1; ++j) basis.lambda[d][j] = static_cast<Scalar>(factor * q[d - 1][j]);
  }
  return basis;
}

/// The basis at t from the knots around its non-empty span, τ_i <= t <= τ_{i+1}.
template <int Order, int D, typename Scalar, TimePoint Time>
[[nodiscard]] inline CumulativeBasis<Scalar, Order, D> nonuniform_basis(
    std::span<const Time, static_cast<std::size_t>(2 * Order - 2)> knots, Time t) {
  using Real = Constant<Scalar>;
  constexpr std::size_t k = Order;
  std::array<Real, k - 1> before, behind;
  for (std::size_t s = 0; s < k - 1; ++s) {
    before[s] = units_between<Real>(knots[s], t);
    behind[s] = units_between<Real>(t, knots[k - 1 + s]);
  }
  return nonuniform_basis<Order, D, Scalar>(knots, before, behind);
}

}  // namespace splinertia::detail
