// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/spline/fit/detail/banded_system.hpp>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

// Whatever the scalar, the dense reference is one type: it is more accurate, and compiled once.
using Dense = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using DenseVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

template <typename System>
DenseVector dense(const typename System::Vector& x) {
  constexpr int dof = System::Block::RowsAtCompileTime, border = System::Corner::RowsAtCompileTime;
  const auto n = static_cast<Eigen::Index>(x.blocks.size());
  DenseVector result(n * dof + border);
  for (Eigen::Index i = 0; i < n; ++i) {
    result.segment(i * dof, dof) = x.blocks[static_cast<std::size_t>(i)].template cast<long double>();
  }
  result.tail(border) = x.border.template cast<long double>();
  return result;
}

[[nodiscard]] long double condition_of(const Dense& A) {
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<Dense>(A, Eigen::EigenvaluesOnly).eigenvalues();
  return eigenvalues[eigenvalues.size() - 1] / eigenvalues[0];
}

/// The same least squares twice: summed by a BandedSystem, and as one matrix of all residuals.
template <typename Scalar, int Dof, int Reach, int Border>
struct Problem {
  static constexpr int rows = 3;  // of each residual
  using System = BandedSystem<Scalar, Dof, Reach, Border>;

  explicit Problem(std::size_t blocks)
      : system(blocks), n(static_cast<Eigen::Index>(blocks)), unknowns(n * Dof + Border) {
    for (std::size_t first = 0; first + Reach < blocks; ++first) {
      for (int again = 0; again < 2 * Dof; ++again) add<Reach + 1>(first);
    }
    // Not all residuals meet as many control points as there may be.
    for (std::size_t first = 0; first < blocks; ++first) add<1>(first);
    if constexpr (Border > 0) {
      const Eigen::Matrix<Scalar, rows, 1> residual = random_matrix<1>();
      const Eigen::Matrix<Scalar, rows, Border> jacobian = random_matrix<Border>();
      system.add_border(residual, jacobian);
      grow();
      J.bottomRightCorner(rows, Border) = jacobian.template cast<long double>();
      r.tail(rows) = residual.template cast<long double>();
    }
  }

  template <int Columns>
  Eigen::Matrix<Scalar, rows, Columns> random_matrix() {
    return Eigen::Matrix<Scalar, rows, Columns>::NullaryExpr([&] { return Scalar(random.symmetric()); });
  }
  void grow() {
    J.conservativeResize(J.rows() + rows, unknowns);
    J.bottomRows(rows).setZero();
    r.conservativeResize(r.size() + rows);
  }
  template <std::size_t N>
  void add(std::size_t first) {
    const Eigen::Matrix<Scalar, rows, 1> residual = random_matrix<1>();
    std::array<Eigen::Matrix<Scalar, rows, Dof>, N> jacobian;
    for (auto& block : jacobian) block = random_matrix<Dof>();
    grow();
    r.tail(rows) = residual.template cast<long double>();
    for (std::size_t i = 0; i < N; ++i) {
      J.block(J.rows() - rows, static_cast<Eigen::Index>(first + i) * Dof, rows, Dof) =
          jacobian[i].template cast<long double>();
    }
    if constexpr (Border > 0) {
      const Eigen::Matrix<Scalar, rows, Border> border = random_matrix<Border>();
      J.bottomRightCorner(rows, Border) = border.template cast<long double>();
      system.add(first, residual, jacobian, border);
    } else {
      system.add(first, residual, jacobian);
    }
  }

  testing::Random random{17};
  System system;
  Eigen::Index n, unknowns;
  Dense J;
  DenseVector r;
};

template <typename Scalar, int Dof, int Reach, int Border>
void check_against_dense(std::size_t blocks) {
  INFO("dof " << Dof << ", reach " << Reach << ", border " << Border << ", blocks " << blocks);
  using P = Problem<Scalar, Dof, Reach, Border>;
  using System = typename P::System;
  const P problem(blocks);
  const Dense A = problem.J.transpose() * problem.J;
  // Rounding, times the number of terms that a sum has.
  const auto rounding = static_cast<long double>(10 * problem.unknowns) *
                        static_cast<long double>(std::numeric_limits<Scalar>::epsilon());

  const typename System::Vector b = problem.system.right;
  const DenseVector expected_b = -problem.J.transpose() * problem.r;
  CHECK((dense<System>(b) - expected_b).norm() <= rounding * expected_b.norm());
  CHECK((dense<System>(multiply(problem.system, b)) - A * expected_b).norm() <=
        rounding * A.norm() * expected_b.norm());
  CHECK(std::abs(b.dot(b) - expected_b.squaredNorm()) <= rounding * expected_b.squaredNorm());

  for (const float damping : {0.0f, 0.5f}) {
    INFO("damping " << damping);
    BandedCholesky<System> factor;
    REQUIRE(factor.compute(problem.system, Scalar(damping)));
    typename System::Vector x = b;
    factor.solve(x);
    Dense damped = A;
    damped.diagonal() *= 1 + damping;
    const Dense inverse = damped.inverse();
    const DenseVector expected = inverse * expected_b;
    const long double tolerance = rounding * condition_of(damped);
    CHECK(tolerance < 1);
    CHECK((dense<System>(x) - expected).norm() <= tolerance * expected.norm());
    if constexpr (Border > 0) {
      const Dense covariance = inverse.bottomRightCorner(Border, Border);
      CHECK((factor.border_covariance().template cast<long double>() - covariance).norm() <=
            tolerance * covariance.norm());
    }
  }
}

}  // namespace

TEST_CASE("A banded system is solved as the dense one") {
  check_against_dense<float, 3, 3, 2>(10);
  check_against_dense<double, 3, 3, 2>(10);
  check_against_dense<double, 3, 3, 2>(4);  // all meet all
  check_against_dense<double, 6, 4, 0>(8);
  check_against_dense<double, 1, 0, 0>(5);  // none meets another
  check_against_dense<long double, 2, 1, 0>(9);
}

TEST_CASE("The step of the normal equations is that of least squares") {
  const Problem<double, 3, 3, 2> problem(9);
  using System = decltype(problem)::System;
  BandedCholesky<System> factor;
  REQUIRE(factor.compute(problem.system, 0));
  auto x = problem.system.right;
  factor.solve(x);
  const DenseVector expected = problem.J.householderQr().solve(-problem.r);
  CHECK((dense<System>(x) - expected).norm() < 1e-12L);  // condition 10³
}

TEST_CASE("A matrix that is not positive definite has no factor") {
  using System = BandedSystem<double, 3, 3, 2>;
  System system(5);
  BandedCholesky<System> factor;
  CHECK_FALSE(factor.compute(system, 0));  // zero
  CHECK_FALSE(factor.compute(system, 1));
  Problem<double, 3, 3, 2> problem(5);
  REQUIRE(factor.compute(problem.system, 0));
  auto broken = problem.system;
  broken.rows[3].lower[0](1, 1) *= -1;
  CHECK_FALSE(factor.compute(broken, 0));
  broken = problem.system;
  broken.corner *= -1;
  CHECK_FALSE(factor.compute(broken, 0));
  broken = problem.system;
  broken.rows[2].lower[1](0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(factor.compute(broken, 0));
  broken = problem.system;
  broken.rows[4].lower[0](0, 0) = std::numeric_limits<double>::infinity();
  CHECK_FALSE(factor.compute(broken, 0));
  // A factor that failed computes the next as if nothing had been.
  CHECK(factor.compute(problem.system, 0));

  problem.system.clear();
  CHECK(problem.system.right.dot(problem.system.right) == 0);
  CHECK_FALSE(factor.compute(problem.system, 0));
}
