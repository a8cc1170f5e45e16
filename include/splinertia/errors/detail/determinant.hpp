// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <utility>

namespace splinertia::detail {

/// The determinant of a small square matrix, by elimination with partial pivoting: Golub, Van Loan, Matrix Computations
/// (2013), 3.4. Eigen's own would need its header of LU decompositions.
template <typename Scalar, int N>
[[nodiscard]] Scalar determinant_of(Eigen::Matrix<Scalar, N, N> matrix) {
  Scalar determinant(1);
  for (int i = 0; i < N; ++i) {
    int pivot = 0;
    if (!(matrix.col(i).tail(N - i).cwiseAbs().maxCoeff(&pivot) > Scalar(0))) return Scalar(0);
    if (pivot > 0) {
      matrix.row(i).swap(matrix.row(i + pivot));
      determinant = -determinant;
    }
    determinant *= matrix(i, i);
    for (int k = i + 1; k < N; ++k) {
      const Scalar factor = matrix(k, i) / matrix(i, i);
      for (int j = i; j < N; ++j) matrix(k, j) -= factor * matrix(i, j);
    }
  }
  return determinant;
}

}  // namespace splinertia::detail
