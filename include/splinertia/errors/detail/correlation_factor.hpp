// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <splinertia/detail/require.hpp>

namespace splinertia::detail {

/// The lower triangular L with L·Lᵀ = R for a matrix R of correlation coefficients, singular or not. Throws
/// std::invalid_argument, in the name of `whose`, unless R has ones on its diagonal, is symmetric and has no negative
/// eigenvalue but by rounding. Cholesky's factorisation: Golub, Van Loan, Matrix Computations (2013), 4.2.
template <typename Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, N> correlation_factor(const char* whose, const Eigen::Matrix<Scalar, N, N>& R) {
  using std::sqrt;
  const Scalar rounding = Scalar(8 * N) * std::numeric_limits<Scalar>::epsilon();
  Eigen::Matrix<Scalar, N, N> L = Eigen::Matrix<Scalar, N, N>::Zero();
  for (int j = 0; j < N; ++j) {
    require(R(j, j) == Scalar(1), whose, "correlation", R(j, j), "1 on the diagonal");
    const Scalar pivot = Scalar(1) - L.row(j).squaredNorm();
    require(pivot >= -rounding, whose, "pivot of the correlation", pivot, "a matrix without negative eigenvalues");
    const bool independent = pivot > rounding;  // of the axes before it
    if (independent) L(j, j) = sqrt(pivot);
    for (int i = j + 1; i < N; ++i) {
      require(R(i, j) == R(j, i), whose, "correlation", R(i, j), "a symmetric matrix");
      const Scalar rest = R(i, j) - L.row(i).dot(L.row(j));
      require(independent || rest * rest <= rounding, whose, "correlation", R(i, j),
              "a matrix without negative eigenvalues");
      if (independent) L(i, j) = rest / L(j, j);
    }
  }
  return L;
}

}  // namespace splinertia::detail
