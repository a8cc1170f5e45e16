// SPDX-License-Identifier: MIT
/// Cumulative B-spline basis functions λ_0 … λ_{k−1} of order k on one segment, λ_j = Σ_{l ≥ j} B_l. λ_0 = 1 is
/// omitted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/group/detail/stumpff.hpp>
#include <utility>

namespace splinertia {

namespace detail {

/// The supported orders: 2 is linear, 4 cubic.
inline constexpr int lowest_order = 2, highest_order = 8;
template <int Order>
inline constexpr bool is_supported_order = lowest_order <= Order && Order <= highest_order;

}  // namespace detail

/// λ_1 … λ_{k−1} and their first D derivatives with respect to time, at one time.
template <typename Scalar, int Order, int D>
struct CumulativeBasis {
  static_assert(detail::is_supported_order<Order>, "orders 2 (linear) to 8 are supported");
  /// lambda[m][j − 1] = d^m λ_j/dt^m, in 1/s^m.
  detail::FixedArray<detail::FixedArray<Scalar, Order - 1>, D + 1> lambda;
};

namespace detail {

[[nodiscard]] constexpr std::int64_t binomial(int n, int k) {
  std::int64_t result = 1;
  for (int i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
  return result;
}

[[nodiscard]] constexpr std::int64_t factorial(int n) {
  std::int64_t result = 1;
  for (int i = 2; i <= n; ++i) result *= i;
  return result;
}

template <int Order>
using BasisMatrix = FixedArray<FixedArray<std::int64_t, Order>, Order>;

/// (k − 1)! times the basis matrix of uniform knots, which makes it integer. Row j, column n holds the coefficient of
/// uⁿ in (k − 1)! B_j(u). K. Qin, "General matrix representations for B-splines", The Visual Computer 16 (2000), (7).
template <int Order>
[[nodiscard]] constexpr BasisMatrix<Order> uniform_basis_matrix() {
  constexpr auto power = [](std::int64_t base, int exponent) {
    std::int64_t result = 1;
    for (int i = 0; i < exponent; ++i) result *= base;
    return result;
  };
  BasisMatrix<Order> m{};
  for (int j = 0; j < Order; ++j) {
    for (int n = 0; n < Order; ++n) {
      std::int64_t sum = 0;
      for (int l = j; l < Order; ++l) {
        const std::int64_t sign = (l - j) % 2 == 0 ? 1 : -1;
        sum += sign * binomial(Order, l - j) * power(Order - 1 - l, Order - 1 - n);
      }
      m[static_cast<std::size_t>(j)][static_cast<std::size_t>(n)] = binomial(Order - 1, n) * sum;
    }
  }
  return m;
}

/// (k − 1)! times the matrix of the cumulative basis: row j is the sum of rows j … k − 1 of uniform_basis_matrix().
template <int Order>
[[nodiscard]] constexpr BasisMatrix<Order> uniform_cumulative_matrix() {
  BasisMatrix<Order> m = uniform_basis_matrix<Order>();
  for (std::size_t j = Order - 1; j-- > 0;) {
    for (std::size_t n = 0; n < Order; ++n) m[j][n] += m[j + 1][n];
  }
  return m;
}

static_assert([] {
  constexpr BasisMatrix<4> matrix = uniform_cumulative_matrix<4>();
  constexpr std::int64_t cubic[4][4] = {{6, 0, 0, 0}, {5, 3, -3, 1}, {1, 3, 3, -2}, {0, 0, 0, 1}};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (matrix[j][n] != cubic[j][n]) return false;
    }
  }
  return true;
}());

/// (k − 1)! d^m λ_j/du^m by Horner's rule. The coefficients are exact; only the evaluation rounds.
template <int Order, int j, int m, typename Scalar>
[[nodiscard]] inline Scalar uniform_basis_polynomial(const Scalar& u) {
  constexpr auto coefficient = [](std::size_t power) {
    constexpr auto matrix = uniform_cumulative_matrix<Order>();
    return matrix[j][power] * factorial(static_cast<int>(power)) / factorial(static_cast<int>(power) - m);
  };
  Scalar sum(static_cast<Constant<Scalar>>(coefficient(Order - 1)));
  [&]<std::size_t... Index>(std::index_sequence<Index...>) {
    [[maybe_unused]] const auto step = [&]<std::size_t i>() {
      constexpr std::int64_t next = coefficient(Order - 2 - i);
      if constexpr (next == 0) {
        sum *= u;
      } else {
        sum = sum * u + static_cast<Constant<Scalar>>(next);
      }
    };
    (step.template operator()<Index>(), ...);
  }(std::make_index_sequence<static_cast<std::size_t>(Order - 1 - m)>{});
  return sum;
}

}  // namespace detail

/// The basis of uniform knots at u ∈ [0, 1] of a segment of length `interval`, s. The error is at most 0.7 eps of the
/// largest value and 1.6 eps of the largest derivative. If Scalar is a type of automatic differentiation but nothing is
/// differentiated with respect to time, U may be a plain type.
template <int Order, int D, typename U, typename Scalar = U>
[[nodiscard]] inline CumulativeBasis<Scalar, Order, D> uniform_basis(const U& u, const U& interval) {
  using Real = detail::Constant<U>;
  CumulativeBasis<Scalar, Order, D> basis;
  const auto row = [&]<std::size_t m>(const U& scale) {
    [&]<std::size_t... J>(std::index_sequence<J...>) {
      if constexpr (m < Order) {
        ((basis.lambda[m][J] = static_cast<Scalar>(detail::uniform_basis_polynomial<Order, J + 1, m>(u) * scale)), ...);
      } else {
        ((basis.lambda[m][J] = Scalar(0)), ...);
      }
    }(std::make_index_sequence<static_cast<std::size_t>(Order - 1)>{});
  };
  const U scale(Real(1) / static_cast<Real>(detail::factorial(Order - 1)));
  row.template operator()<0>(scale);
  if constexpr (D >= 1) row.template operator()<1>(scale / interval);
  if constexpr (D >= 2) row.template operator()<2>(scale / interval / interval);
  if constexpr (D >= 3) row.template operator()<3>(scale / interval / interval / interval);
  return basis;
}

}  // namespace splinertia
