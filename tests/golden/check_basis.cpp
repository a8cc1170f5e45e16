// SPDX-License-Identifier: MIT
/// Tables of the basis functions: basis_matrix, basis_uniform, basis_nonuniform.
#include <splinertia/spline/basis.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>

#include "check_orders.hpp"
#include "golden_checks.hpp"

namespace golden {

namespace {

template <int Order>
[[nodiscard]] Numbers entries(const splinertia::detail::BasisMatrix<Order>& m) {
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
    const auto got = entries<Order>(cumulative ? splinertia::detail::uniform_cumulative_matrix<Order>()
                                               : splinertia::detail::uniform_basis_matrix<Order>());
    grader.check("entries", got == row.outputs("entries") ? Numbers{0} : Numbers{1}, {0});
    grader.check("denominator", {static_cast<long double>(splinertia::detail::factorial(Order - 1))},
                 row.outputs("denominator"));
  });
}

/// max_j |d^m λ_j/du^m|, straight from the matrix.
template <int Order>
[[nodiscard]] long double largest_derivative(int m, long double u) {
  constexpr auto matrix = splinertia::detail::uniform_cumulative_matrix<Order>();
  long double largest = 0;
  for (const auto& row : matrix) {
    long double sum = 0;
    for (int n = Order - 1; n >= m; --n) {
      sum = sum * u + static_cast<long double>(row[static_cast<std::size_t>(n)] * splinertia::detail::factorial(n) /
                                               splinertia::detail::factorial(n - m));
    }
    largest = std::max(largest, std::abs(sum));
  }
  return largest / static_cast<long double>(splinertia::detail::factorial(Order - 1));
}

/// Derivative m of λ_0 = 1, λ_1 … λ_{k−1}, and of the plain basis B_j = λ_j − λ_{j+1}, which the library has no other
/// use for: its errors are those of the two, so that it is held to the size of the λ too.
template <typename Scalar, int Order>
void compare_basis(const Row& row, Grader<Scalar>& grader, const splinertia::CumulativeBasis<Scalar, Order, 3>& basis,
                   const Measure& measure) {
  const int m = row.integer("m");
  const auto gold = row.outputs("lambda");
  Numbers lambda{m == 0 ? 1.0L : 0.0L};
  for (const Scalar x : basis.lambda[static_cast<std::size_t>(m)]) lambda.push_back(static_cast<long double>(x));
  Numbers plain = lambda;
  for (std::size_t j = 0; j + 1 < plain.size(); ++j) plain[j] -= lambda[j + 1];
  const long double size = magnitude(gold);
  grader.check("lambda", lambda, gold, measure);
  grader.check("B", plain, row.outputs("B"), {size + measure.scale, size + measure.cond});
}

template <typename Scalar>
void check_uniform_row(const Row& row, Report& report) {
  for_order(row, report, [&]<int Order>() {
    Grader<Scalar> grader(report, row);
    const int m = row.integer("m");
    if (m > 3) return grader.skip();  // the library has three derivatives
    const auto u = row.input<Scalar>("u");
    const auto basis = splinertia::uniform_basis<Order, 3>(u, Scalar(1));
    const auto wide = static_cast<long double>(u);
    const long double cond = m + 1 < Order ? wide * largest_derivative<Order>(m + 1, wide) : 0;
    compare_basis(row, grader, basis, {0, cond});
    // (k − 1)! λ_{k−1} = u^{k−1} has nothing that could cancel.
    const long double last = row.outputs("lambda").back();
    grader.check("last lambda", {static_cast<long double>(basis.lambda[static_cast<std::size_t>(m)].back())}, {last},
                 {0, (Order - 1) * std::abs(last)});
  });
}

/// The recursion of nonuniform_basis.hpp in sizes: the sum of its terms, whatever their signs.
struct TermSizes {
  const std::vector<double>& knots;
  std::size_t span;
  long double t;

  [[nodiscard]] long double tau(std::size_t i) const { return knots[i]; }
  /// B_{j,order}(t)
  [[nodiscard]] long double B(std::size_t j, std::size_t order) const {
    if (order == 1) return j == span ? 1 : 0;
    return (t - tau(j)) * quotient(j, order - 1, 0) + (tau(j + order) - t) * quotient(j + 1, order - 1, 0);
  }
  /// Derivative m of B_{j,order} / (τ_{j+order} − τ_j).
  [[nodiscard]] long double quotient(std::size_t j, std::size_t order, int m) const {
    if (j > span || j + order <= span) return 0;
    const long double width = tau(j + order) - tau(j);
    if (m == 0) return B(j, order) / width;
    if (order == 1) return 0;
    const long double below = quotient(j, order - 1, m - 1) + quotient(j + 1, order - 1, m - 1);
    return static_cast<long double>(order - 1) * below / width;
  }
  /// The largest of λ_0 … λ_{k−1}, or of their derivatives m.
  [[nodiscard]] long double largest(std::size_t order, int m) const {
    if (m == 0) return 1;
    long double size = 0;
    for (std::size_t j = span + 2 - order; j <= span; ++j) size = std::max(size, quotient(j, order - 1, m - 1));
    return static_cast<long double>(order - 1) * size;
  }
};

/// The table has no scale. That of the values and first derivatives, sums of positive terms, is the largest of them.
/// Higher derivatives are differences, which knots of unequal distances can make vanish all at once: theirs is the
/// largest sum of the terms' sizes, |gold| where nothing cancels. There is no condition: knots and times are doubles
/// whatever Scalar is, and differences of them are rounded to Scalar only once, so that float is held to the same.
template <typename Scalar>
void check_nonuniform_row(const Row& row, Report& report) {
  for_order(row, report, [&]<int Order>() {
    Grader<Scalar> grader(report, row);
    const int m = row.integer("m");
    if (m > 3) return grader.skip();  // the library has three derivatives
    const splinertia::NonUniformKnots<double> knots{row.inputs<double>("knots")};
    const auto control_points = static_cast<std::size_t>(row.integer("n"));
    const auto t = row.input<double>("t");
    knots.check(control_points, Order);
    const auto place = knots.basis<Scalar, Order, 3>(t, control_points);
    const std::size_t span = place.first + static_cast<std::size_t>(Order) - 1;
    grader.check("span", {static_cast<long double>(span)}, row.outputs("span"));

    const auto gold = row.outputs("lambda");
    const long double scale = TermSizes{knots.knots, span, t}.largest(Order, m);
    const long double beyond = std::max(0.0L, scale - magnitude(gold));  // the grade adds |gold|
    compare_basis(row, grader, place.basis, {beyond, beyond});
    // Each value is a sum of positive terms, and so accurate by itself, to a few roundings for each order.
    for (std::size_t j = 1; m == 0 && j < gold.size(); ++j) {
      const long double size = (Order - 1) * gold[j];
      grader.check("a lambda", {static_cast<long double>(place.basis.lambda[0][j - 1])}, {gold[j]}, {size, size});
    }
  });
}

}  // namespace

void check_basis_matrix(const Table& table, Report& report) {
  for (std::size_t i = 0; i < table.size(); ++i) check_matrix_row(table[i], report);
}

void check_basis_uniform(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_uniform_row<Scalar>(row, report); });
  report.note(table.name(), "rows of m > 3 skipped (the library has three derivatives)");
}

void check_basis_nonuniform(const Table& table, Report& report) {
  for_all_scalars(table, [&]<typename Scalar>(const Row& row) { check_nonuniform_row<Scalar>(row, report); });
}

}  // namespace golden
