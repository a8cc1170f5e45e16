// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Jacobi>
#include <cmath>
#include <limits>
#include <splinertia/detail/require.hpp>

namespace splinertia::detail {

/// How far an N×N matrix of correlation coefficients may be from one, in each coefficient. D S D with the covariance
/// S = A·Aᵀ, D = diag(S)^(−1/2), A of N columns, is off by less than (N + 4) eps: N for the sums, 4 for the scaling.
template <typename Scalar, int N>
inline constexpr Scalar correlation_rounding = Scalar(8 * N) * std::numeric_limits<Scalar>::epsilon();

/// The symmetric part of R with ones on its diagonal. Throws std::invalid_argument, in the name of `whose`, unless R is
/// that but for correlation_rounding.
template <typename Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, N> correlation_part(const char* whose, const Eigen::Matrix<Scalar, N, N>& R) {
  using std::abs;
  constexpr Scalar rounding = correlation_rounding<Scalar, N>;
  Eigen::Matrix<Scalar, N, N> part = Eigen::Matrix<Scalar, N, N>::Identity();
  for (int j = 0; j < N; ++j) {
    require(abs(R(j, j) - Scalar(1)) <= rounding, whose, "correlation", R(j, j), "1 on the diagonal");
    for (int i = j + 1; i < N; ++i) {
      require(abs(R(i, j)) <= Scalar(1) + rounding, whose, "correlation", R(i, j), "a number >= -1 and <= 1");
      require(abs(R(i, j) - R(j, i)) <= rounding, whose, "correlation", R(i, j), "a symmetric matrix");
      part(i, j) = part(j, i) = (R(i, j) + R(j, i)) / Scalar(2);
    }
  }
  return part;
}

/// Cholesky's factorisation of R: Golub, Van Loan, Matrix Computations (2013), 4.2. Returns false if rounding spoils it,
/// which happens for a singular R only: it amplifies rounding by the reciprocal of the pivots before.
template <typename Scalar, int N>
[[nodiscard]] bool factor_by_cholesky(const Eigen::Matrix<Scalar, N, N>& R, Eigen::Matrix<Scalar, N, N>& L) {
  using std::sqrt;
  constexpr Scalar rounding = correlation_rounding<Scalar, N>;
  L.setZero();
  for (int j = 0; j < N; ++j) {
    const Scalar pivot = Scalar(1) - L.row(j).squaredNorm();
    if (!(pivot >= -rounding)) return false;
    const bool independent = pivot > rounding;  // of the axes before it
    if (independent) L(j, j) = sqrt(pivot);
    for (int i = j + 1; i < N; ++i) {
      const Scalar rest = R(i, j) - L.row(i).dot(L.row(j));
      if (!independent && !(rest * rest <= rounding)) return false;
      if (independent) L(i, j) = rest / L(j, j);
    }
  }
  return true;
}

/// Turns R into the diagonal matrix of its eigenvalues and returns the eigenvectors as columns: Jacobi's method, Golub,
/// Van Loan, 8.5. Eigen's own solvers would need a large header.
template <typename Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, N> diagonalize(Eigen::Matrix<Scalar, N, N>& R) {
  using std::abs;
  Eigen::Matrix<Scalar, N, N> vectors = Eigen::Matrix<Scalar, N, N>::Identity();
  bool diagonal = false;
  for (int sweep = 0; sweep < 50 && !diagonal; ++sweep) {  // 4 to 8 are enough: the convergence is quadratic
    diagonal = true;
    for (int q = 1; q < N; ++q) {
      for (int p = 0; p < q; ++p) {
        if (!(abs(R(p, q)) > std::numeric_limits<Scalar>::epsilon() / Scalar(2 * N))) continue;
        diagonal = false;
        Eigen::JacobiRotation<Scalar> rotation;
        rotation.makeJacobi(R, p, q);
        R.applyOnTheLeft(p, q, rotation.adjoint());
        R.applyOnTheRight(p, q, rotation);
        vectors.applyOnTheRight(p, q, rotation);
      }
    }
  }
  return vectors;
}

/// A matrix L with L·Lᵀ = R for a matrix R of correlation coefficients as correlation_part() returns it, singular or
/// not. It is lower triangular where factor_by_cholesky() succeeds, else V·√Λ of the eigenvalues Λ. Throws
/// std::invalid_argument, in the name of `whose`, unless all eigenvalues are >= −N·correlation_rounding, as much as
/// rounding can change them.
template <typename Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, N> correlation_factor(const char* whose, const Eigen::Matrix<Scalar, N, N>& R) {
  Eigen::Matrix<Scalar, N, N> values = R;
  const Eigen::Matrix<Scalar, N, N> vectors = diagonalize(values);
  const Scalar least = values.diagonal().minCoeff();
  require(least >= -Scalar(N) * correlation_rounding<Scalar, N>, whose, "eigenvalue of the correlation", least,
          "a matrix without negative eigenvalues");
  Eigen::Matrix<Scalar, N, N> L;
  if (factor_by_cholesky(R, L)) return L;
  return vectors * values.diagonal().cwiseMax(Scalar(0)).cwiseSqrt().asDiagonal();
}

}  // namespace splinertia::detail
