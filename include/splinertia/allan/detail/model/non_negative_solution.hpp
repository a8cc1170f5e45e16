// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace splinertia::allan::detail {

/// Non-negative least squares: the minimum of xᵀAx/2 − bᵀx over x ≥ 0 with x_j = 0 unless bit j of `candidates` is set.
/// A is the matrix of the normal equations, b their right side; A may be singular or badly scaled. Exact: it tries all
/// subsets of unknowns at zero, which suits a handful of unknowns. The subset with none at zero comes first: if its
/// solution is non-negative, it is the best.
template <typename Scalar, int Size>
[[nodiscard]] Eigen::Matrix<Scalar, Size, 1> non_negative_solution(const Eigen::Matrix<Scalar, Size, Size>& A,
                                                                   const Eigen::Matrix<Scalar, Size, 1>& b,
                                                                   unsigned candidates) {
  static_assert(Size <= 8);
  using Vector = Eigen::Matrix<Scalar, Size, 1>;
  // Scales the unknowns so that A has a unit diagonal.
  Vector scale = Vector::Zero();
  for (int j = 0; j < Size; ++j) {
    if (A(j, j) > 0) scale[j] = 1 / std::sqrt(A(j, j));
  }
  const Eigen::Matrix<Scalar, Size, Size> scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Vector right = scale.cwiseProduct(b);
  Vector best = Vector::Zero();
  Scalar best_gain = 0;
  for (unsigned free = candidates; free != 0; free = (free - 1) & candidates) {
    Eigen::Matrix<Scalar, Size, Size> system = Eigen::Matrix<Scalar, Size, Size>::Identity();
    Vector free_right = Vector::Zero();
    for (int j = 0; j < Size; ++j) {
      if ((free >> j & 1u) == 0) continue;
      free_right[j] = right[j];
      for (int k = 0; k < Size; ++k) {
        if (free >> k & 1u) system(j, k) = scaled(j, k);
      }
    }
    const Vector solution = system.partialPivLu().solve(free_right);
    const Scalar gain = solution.dot(free_right);
    if (solution.minCoeff() >= 0 && gain > best_gain) {
      best_gain = gain;
      best = solution;
      if (free == candidates) break;
    }
  }
  return scale.cwiseProduct(best);
}

}  // namespace splinertia::allan::detail
