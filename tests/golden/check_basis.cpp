// SPDX-License-Identifier: MIT
/// Tables of the basis functions of uniform knots: basis_matrix, basis_uniform.
#include <splinertia/spline/basis.hpp>

#include "check_orders.hpp"
#include "golden_checks.hpp"

namespace golden {

namespace {

template <int Order>
[[nodiscard]] Numbers entries(const splinertia::BasisMatrix<Order>& m) {
  Numbers values;
  for (const auto& row : m) {
    for (const auto x : row) values.push_back(static_cast<long double>(x));
  }
  return values;
}

/// Integers, which must be exact: any difference is an infinite C.
void check_matrix_row(const Row& row, Report& report) {
  for_order(row, report, [&]<int Order>() {
    Grader<double> grader(report, row);
    const bool cumulative = row.text("kind") == "cumulative";
    const auto got = entries<Order>(cumulative ? splinertia::uniform_cumulative_matrix<Order>()
                                               : splinertia::uniform_basis_matrix<Order>());
    grader.check("entries", got == row.outputs("entries") ? Numbers{0} : Numbers{1}, {0});
    grader.check("denominator", {static_cast<long double>(splinertia::factorial(Order - 1))},
                 row.outputs("denominator"));
  });
}

/// max_j |d^m λ_j/du^m|, straight from the matrix.
template <int Order>
[[nodiscard]] long double largest_derivative(int m, long double u) {
  constexpr auto matrix = splinertia::uniform_cumulative_matrix<Order>();
  long double largest = 0;
  for (const auto& row : matrix) {
    long double sum = 0;
    for (int n = Order - 1; n >= m; --n) {
      sum = sum * u + static_cast<long double>(row[static_cast<std::size_t>(n)] * splinertia::factorial(n) /
                                               splinertia::factorial(n - m));
    }
    largest = std::max(largest, std::abs(sum));
  }
  return largest / static_cast<long double>(splinertia::factorial(Order - 1));
}

template <typename Scalar>
void check_uniform_row(const Row& row, Report& report) {
  for_order(row, report, [&]<int Order>() {
    Grader<Scalar> grader(report, row);
    const int m = row.integer("m");
    if (m > 3) return grader.skip();  // the library has three derivatives
    const auto u = row.input<Scalar>("u");
    const auto basis = splinertia::uniform_basis<Order, 3>(u, Scalar(1));
    const auto gold = row.outputs("lambda");
    Numbers got{m == 0 ? 1.0L : 0.0L};
    for (const Scalar x : basis.lambda[static_cast<std::size_t>(m)]) got.push_back(static_cast<long double>(x));
    const auto wide = static_cast<long double>(u);
    const long double cond = m + 1 < Order ? wide * largest_derivative<Order>(m + 1, wide) : 0;
    grader.check("lambda", got, gold, {0, cond});
    // (k − 1)! λ_{k−1} = u^{k−1} has nothing that could cancel.
    grader.check("last lambda", {got.back()}, {gold.back()}, {0, (Order - 1) * std::abs(gold.back())});
  });
}

}  // namespace

void check_basis_matrix(const Table& table, Report& report) {
  for (std::size_t i = 0; i < table.size(); ++i) check_matrix_row(table[i], report);
}

void check_basis_uniform(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_uniform_row<Scalar>(row, report); });
  report.note(table.name(),
              "column not checked: B (the library computes the cumulative basis only); "
              "rows of m > 3 skipped (the library has three derivatives)");
}

}  // namespace golden
