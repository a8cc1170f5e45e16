// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <splinertia/allan/detail/model/non_negative_solution.hpp>

#include "support/catch.hpp"

using splinertia::allan::detail::non_negative_solution;

namespace {

constexpr int size = 4;
using Vector = Eigen::Vector4d;
using Matrix = Eigen::Matrix4d;

double objective(const Matrix& A, const Vector& b, const Vector& x) { return x.dot(A * x) / 2 - b.dot(x); }

/// The conditions of Karush, Kuhn and Tucker, in units of each unknown: a gradient of zero where x is free, none
/// downwards where it is at zero.
void check_optimal(const Matrix& A, const Vector& b, unsigned candidates, const Vector& x, double tolerance) {
  const Vector gradient = A * x - b;
  for (int j = 0; j < size; ++j) {
    INFO("unknown " << j << " of set " << candidates);
    if ((candidates >> j & 1u) == 0 || A(j, j) == 0) {
      CHECK(x[j] == 0);
      continue;
    }
    CHECK(x[j] >= 0);
    const double scaled = gradient[j] / std::sqrt(A(j, j));
    CHECK(scaled >= -tolerance);
    if (x[j] > 0) CHECK(scaled <= tolerance);
  }
}

struct Problem {
  Eigen::Matrix<double, Eigen::Dynamic, size> J;
  Eigen::VectorXd y;
  [[nodiscard]] Matrix A() const { return J.transpose() * J; }
  [[nodiscard]] Vector b() const { return J.transpose() * y; }
};

Problem random_problem(std::mt19937_64& bits, int rows) {
  std::normal_distribution<double> normal;
  Problem problem{Eigen::MatrixXd(rows, size), Eigen::VectorXd(rows)};
  for (double& value : problem.J.reshaped()) value = normal(bits);
  for (double& value : problem.y.reshaped()) value = normal(bits);
  return problem;
}

}  // namespace

TEST_CASE("The solution is optimal for any set of candidates") {
  std::mt19937_64 bits(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Problem problem = random_problem(bits, 6);
    for (unsigned candidates = 0; candidates < 16; ++candidates) {
      const Vector x = non_negative_solution<double, size>(problem.A(), problem.b(), candidates);
      check_optimal(problem.A(), problem.b(), candidates, x, 1e-10);
    }
  }
}

TEST_CASE("Unknowns of any size") {
  std::mt19937_64 bits(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Problem problem = random_problem(bits, 6);
    const Vector scale(1e-100, 1e70, 1, 1e-20);
    const Vector x = non_negative_solution<double, size>(problem.A(), problem.b(), 15);
    const Vector scaled = non_negative_solution<double, size>(scale.asDiagonal() * problem.A() * scale.asDiagonal(),
                                                              scale.cwiseProduct(problem.b()), 15);
    for (int j = 0; j < size; ++j) CHECK_THAT(scaled[j] * scale[j], WithinAbs(x[j], 1e-9 * (1 + x.norm())));
  }
}

TEST_CASE("Singular matrices have one of their solutions") {
  std::mt19937_64 bits(3);
  for (int trial = 0; trial < 300; ++trial) {
    // Fewer equations than unknowns, of small integers, so that the elimination meets zeros; no power is negative.
    Problem problem = random_problem(bits, 1 + trial % 4);
    problem.J = (problem.J.array().abs() * 2).round();
    problem.y = problem.y.cwiseAbs();
    if (trial % 3 == 0) problem.J.col(2) = 3 * problem.J.col(1);
    if (trial % 5 == 0) problem.J.col(0).setZero();
    const Vector x = non_negative_solution<double, size>(problem.A(), problem.b(), 15);
    REQUIRE(x.allFinite());
    check_optimal(problem.A(), problem.b(), 15, x, 1e-7);
  }
}

TEST_CASE("Nothing to solve") {
  const Vector b(1, 2, 3, 4);
  CHECK(non_negative_solution<double, size>(Matrix::Identity(), b, 0) == Vector::Zero());
  CHECK(non_negative_solution<double, size>(Matrix::Zero(), Vector::Zero(), 15) == Vector::Zero());
  CHECK(non_negative_solution<double, size>(Matrix::Identity(), -b, 15) == Vector::Zero());
  CHECK(non_negative_solution<double, size>(Matrix::Identity(), b, 5) == Vector(1, 0, 3, 0));
  CHECK(objective(Matrix::Identity(), b, non_negative_solution<double, size>(Matrix::Identity(), b, 15)) == -15);
}

TEST_CASE("Other sizes and long double") {
  using Matrix3 = Eigen::Matrix<long double, 3, 3>;
  using Vector3 = Eigen::Matrix<long double, 3, 1>;
  Matrix3 A;
  A << 2, 1, 0, 1, 2, 0, 0, 0, 4;
  const Vector3 x = non_negative_solution<long double, 3>(A, Vector3(4, 5, 1), 7);
  CHECK(std::abs(x[0] - 1) < 1e-18L);
  CHECK(std::abs(x[1] - 2) < 1e-18L);
  CHECK(std::abs(x[2] - 0.25L) < 1e-18L);
  // Unbounded by the others, the first would be −1/3.
  CHECK(non_negative_solution<long double, 3>(A, Vector3(1, 3, 1), 3)[0] == 0);
  CHECK(std::abs(non_negative_solution<long double, 3>(A, Vector3(1, 3, 1), 3)[1] - 1.5L) < 1e-18L);
}
