// SPDX-License-Identifier: MIT
#include <splinertia/spline/basis.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

template <int Order>
constexpr bool partition_of_unity() {
  // The rows of the plain matrix sum to (k − 1)! · 1: the sum of all B_j is 1 whatever u is.
  constexpr auto m = uniform_basis_matrix<Order>();
  for (std::size_t n = 0; n < Order; ++n) {
    std::int64_t sum = 0;
    for (std::size_t j = 0; j < Order; ++j) sum += m[j][n];
    if (sum != (n == 0 ? factorial(Order - 1) : 0)) return false;
  }
  return true;
}
static_assert(partition_of_unity<2>() && partition_of_unity<3>() && partition_of_unity<4>() && partition_of_unity<5>());
static_assert(partition_of_unity<6>() && partition_of_unity<7>() && partition_of_unity<8>());

template <int Order>
constexpr bool continuous_at_knots() {
  // λ_j at u = 1 is λ_{j−1} at u = 0 of the next segment: every row's sum is the constant of the row above.
  constexpr auto m = uniform_cumulative_matrix<Order>();
  for (std::size_t j = 1; j < Order; ++j) {
    std::int64_t sum = 0;
    for (const std::int64_t coefficient : m[j]) sum += coefficient;
    if (sum != m[j - 1][0]) return false;
  }
  return true;
}
static_assert(continuous_at_knots<2>() && continuous_at_knots<3>() && continuous_at_knots<4>() &&
              continuous_at_knots<5>());
static_assert(continuous_at_knots<6>() && continuous_at_knots<7>() && continuous_at_knots<8>());

TEST_CASE("The cumulative basis is that of the control points from j on") {
  constexpr auto plain = uniform_basis_matrix<5>();
  constexpr auto cumulative = uniform_cumulative_matrix<5>();
  const double u = 0.37;
  const auto basis = uniform_basis<5, 0>(u, 1.0);
  for (std::size_t j = 1; j < 5; ++j) {
    double sum = 0, row = 0, power = 1;
    for (std::size_t n = 0; n < 5; ++n, power *= u) {
      for (std::size_t l = j; l < 5; ++l) sum += static_cast<double>(plain[l][n]) / 24 * power;
      row += static_cast<double>(cumulative[j][n]) / 24 * power;
    }
    CHECK_THAT(basis.lambda[0][j - 1], WithinAbs(sum, 1e-15));
    CHECK_THAT(row, WithinAbs(sum, 1e-15));
  }
}

TEST_CASE("Derivatives are with respect to time, not to u") {
  const double h = 1e-3, u = 0.4, interval = 0.25;
  const auto at = [&](double shift) { return uniform_basis<6, 3>(u + shift / interval, interval).lambda; };
  for (std::size_t m = 1; m <= 3; ++m) {
    for (std::size_t j = 0; j < 5; ++j) {
      const double difference =
          (8 * (at(h)[m - 1][j] - at(-h)[m - 1][j]) - (at(2 * h)[m - 1][j] - at(-2 * h)[m - 1][j])) / (12 * h);
      CHECK_THAT(at(0)[m][j], WithinAbs(difference, 1e-6));
    }
  }
}

TEST_CASE("A derivative higher than the degree is zero") {
  const auto basis = uniform_basis<2, 3>(0.4, 0.5);
  CHECK(basis.lambda[1][0] == 2);
  CHECK(basis.lambda[2][0] == 0);
  CHECK(basis.lambda[3][0] == 0);
}
