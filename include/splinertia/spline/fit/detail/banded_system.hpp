// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/fixed_array.hpp>
#include <tuple>
#include <vector>

namespace splinertia::detail {

/// The unknowns of a BandedSystem: a block of Dof numbers for each control point, and Border numbers that may couple
/// with all of them.
template <typename Scalar, int Dof, int Border>
struct BandedVector {
  std::vector<Eigen::Matrix<Scalar, Dof, 1>> blocks;
  Eigen::Matrix<Scalar, Border, 1> border;

  [[nodiscard]] Scalar dot(const BandedVector& other) const {
    Scalar sum(0);
    if constexpr (Border > 0) sum = border.dot(other.border);
    for (std::size_t i = 0; i < blocks.size(); ++i) sum += blocks[i].dot(other.blocks[i]);
    return sum;
  }
  void scale(const Scalar& factor) {
    border *= factor;
    for (auto& block : blocks) block *= factor;
  }
};

/// Normal equations A x = b of least squares over the control points of a spline of order Reach + 1. Each control point
/// couples only with the Reach before and after it, and with the Border unknowns of the whole curve (a bias, a time
/// offset). Memory and time are linear in the number of control points.
///
///       | D  .        B |
///   A = | L  D  .     B |        D, L: Dof × Dof,   B: Dof × Border,   C: Border × Border
///       | L  L  D  .  B |        only the lower triangles of D and C are used
///       | Bᵀ Bᵀ Bᵀ    C |
template <typename Scalar_, int Dof, int Reach, int Border = 0>
class BandedSystem {
 public:
  using Scalar = Scalar_;
  using Block = Eigen::Matrix<Scalar, Dof, Dof>;
  using BorderBlock = Eigen::Matrix<Scalar, Dof, Border>;
  using Corner = Eigen::Matrix<Scalar, Border, Border>;
  using Vector = BandedVector<Scalar, Dof, Border>;
  struct Row {
    FixedArray<Block, Reach + 1> lower;  ///< A(i, i − j), j = 0 … Reach
    BorderBlock border;
  };

  explicit BandedSystem(std::size_t blocks)
      : rows(blocks), right{std::vector<Eigen::Matrix<Scalar, Dof, 1>>(blocks), {}} {
    clear();
  }

  void clear() {
    for (auto& row : rows) {
      row.lower.fill(Block::Zero());
      row.border.setZero();
    }
    for (auto& block : right.blocks) block.setZero();
    corner.setZero();
    right.border.setZero();
  }

  /// Adds |r + Σ J_i δ_i + J_border δ_border|² to the cost whose minimum solves A δ = b. `first` is the index of the
  /// first of the N blocks. If J has fewer columns than Dof, they begin at `column` and the others are zero.
  template <int column = 0, int Rows, int Columns, std::size_t N>
  void add(std::size_t first, const Eigen::Matrix<Scalar, Rows, 1>& r,
           const std::array<Eigen::Matrix<Scalar, Rows, Columns>, N>& J) {
    static_assert(N <= Reach + 1 && column + Columns <= Dof);
    for (std::size_t i = 0; i < N; ++i) {
      right.blocks[first + i].template segment<Columns>(column).noalias() -= J[i].transpose() * r;
      for (std::size_t j = 0; j <= i; ++j) {
        rows[first + i].lower[i - j].template block<Columns, Columns>(column, column) +=
            J[i].transpose().lazyProduct(J[j]);
      }
    }
  }
  template <int Rows, std::size_t N>
    requires(Border > 0)
  void add(std::size_t first, const Eigen::Matrix<Scalar, Rows, 1>& r,
           const std::array<Eigen::Matrix<Scalar, Rows, Dof>, N>& J,
           const Eigen::Matrix<Scalar, Rows, Border>& J_border) {
    add(first, r, J);
    for (std::size_t i = 0; i < N; ++i) rows[first + i].border += J[i].transpose().lazyProduct(J_border);
    add_border(r, J_border);
  }
  /// The same for a residual that depends on no control point.
  template <int Rows>
    requires(Border > 0)
  void add_border(const Eigen::Matrix<Scalar, Rows, 1>& r, const Eigen::Matrix<Scalar, Rows, Border>& J_border) {
    corner += J_border.transpose().lazyProduct(J_border);
    right.border.noalias() -= J_border.transpose() * r;
  }

  std::vector<Row> rows;
  Corner corner;
  Vector right;  ///< b
};

/// Cholesky factorisation A + damping·diag(A) = L Lᵀ of a BandedSystem.
template <typename System>
class BandedCholesky {
 public:
  using Scalar = typename System::Scalar;
  using Vector = typename System::Vector;
  using Corner = typename System::Corner;
  static constexpr int border = Corner::RowsAtCompileTime;

  /// Returns false unless the matrix is positive definite to rounding. solve() is then not allowed.
  [[nodiscard]] bool compute(const System& system, const Scalar& damping) {
    rows_ = system.rows;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].lower[0].diagonal() *= Scalar(1) + damping;
      if (!factorize_row(i)) return false;
    }
    if constexpr (border > 0) {
      corner_ = system.corner;
      corner_.diagonal() *= Scalar(1) + damping;
      for (const auto& row : rows_) corner_ -= row.border.transpose().lazyProduct(row.border);
      return factorize(corner_);
    }
    return true;
  }

  /// Solves the factorised system: x is b before and the solution after.
  void solve(Vector& x) const {
    const std::size_t n = rows_.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 1; j <= reach(i); ++j) x.blocks[i].noalias() -= rows_[i].lower[j] * x.blocks[i - j];
      solve_lower(rows_[i].lower[0], x.blocks[i]);
    }
    if constexpr (border > 0) {
      for (std::size_t i = 0; i < n; ++i) x.border.noalias() -= rows_[i].border.transpose() * x.blocks[i];
      solve_lower(corner_, x.border);
      solve_upper(corner_, x.border);
      for (std::size_t i = 0; i < n; ++i) x.blocks[i].noalias() -= rows_[i].border * x.border;
    }
    for (std::size_t i = n; i-- > 0;) {
      solve_upper(rows_[i].lower[0], x.blocks[i]);
      for (std::size_t j = 1; j <= reach(i); ++j) {
        x.blocks[i - j].noalias() -= rows_[i].lower[j].transpose() * x.blocks[i];
      }
    }
  }

  /// The covariance of the border unknowns if A is an information matrix.
  [[nodiscard]] Corner border_covariance() const
    requires(border > 0)
  {
    Corner inverse = Corner::Identity();
    solve_lower(corner_, inverse);
    return inverse.transpose().lazyProduct(inverse);
  }

 private:
  static constexpr std::size_t largest_reach = std::tuple_size_v<decltype(System::Row::lower)> - 1;

  [[nodiscard]] static std::size_t reach(std::size_t row) { return (std::min)(row, largest_reach); }

  // Plain loops: Eigen's unrolled code for small fixed sizes is no faster here, and takes ten seconds to compile.

  /// Replaces the lower triangle of `matrix` by L with L Lᵀ = matrix. Returns false unless the matrix is positive
  /// definite to rounding.
  template <typename Matrix>
  [[nodiscard]] static bool factorize(Matrix& matrix) {
    using std::sqrt;
    for (int c = 0; c < Matrix::ColsAtCompileTime; ++c) {
      for (int k = 0; k < c; ++k) {
        for (int r = c; r < Matrix::RowsAtCompileTime; ++r) matrix(r, c) -= matrix(r, k) * matrix(c, k);
      }
      const Scalar pivot = matrix(c, c);
      if (!(pivot > Scalar(0)) || !is_finite(pivot)) return false;
      const Scalar inverse = Scalar(1) / sqrt(pivot);
      for (int r = c; r < Matrix::RowsAtCompileTime; ++r) matrix(r, c) *= inverse;
    }
    return true;
  }

  /// Replaces X by L⁻¹ X.
  template <typename Matrix, typename Columns>
  static void solve_lower(const Matrix& L, Columns& X) {
    for (int column = 0; column < Columns::ColsAtCompileTime; ++column) {
      for (int c = 0; c < Matrix::ColsAtCompileTime; ++c) {
        const Scalar x = X(c, column) /= L(c, c);
        for (int r = c + 1; r < Matrix::RowsAtCompileTime; ++r) X(r, column) -= L(r, c) * x;
      }
    }
  }

  /// Replaces x by L⁻ᵀ x.
  template <typename Matrix, typename Column>
  static void solve_upper(const Matrix& L, Column& x) {
    for (int c = Matrix::ColsAtCompileTime; c-- > 0;) {
      for (int r = c + 1; r < Matrix::RowsAtCompileTime; ++r) x[c] -= L(r, c) * x[r];
      x[c] /= L(c, c);
    }
  }

  /// Replaces X by X L⁻ᵀ.
  template <typename Matrix>
  static void solve_from_right(const Matrix& L, Matrix& X) {
    for (int c = 0; c < Matrix::ColsAtCompileTime; ++c) {
      for (int k = 0; k < c; ++k) X.col(c) -= L(c, k) * X.col(k);
      X.col(c) /= L(c, c);
    }
  }

  [[nodiscard]] bool factorize_row(std::size_t i) {
    auto& row = rows_[i].lower;
    for (std::size_t j = reach(i); j > 0; --j) {
      const auto& column = rows_[i - j].lower;
      for (std::size_t k = j + 1; k <= reach(i); ++k) {
        row[j].noalias() -= row[k] * column[k - j].transpose();
      }
      solve_from_right(column[0], row[j]);
    }
    for (std::size_t j = 1; j <= reach(i); ++j) row[0].noalias() -= row[j] * row[j].transpose();
    if (!factorize(row[0])) return false;
    if constexpr (border > 0) {
      auto& own = rows_[i].border;
      for (std::size_t j = 1; j <= reach(i); ++j) own -= row[j].lazyProduct(rows_[i - j].border);
      solve_lower(row[0], own);
    }
    return true;
  }

  std::vector<typename System::Row> rows_;
  Corner corner_;
};

/// A x.
template <typename System>
[[nodiscard]] typename System::Vector multiply(const System& A, const typename System::Vector& x) {
  typename System::Vector y = x;
  const std::size_t n = x.blocks.size();
  using Block = typename System::Block;
  for (std::size_t i = 0; i < n; ++i) {
    const Block diagonal = A.rows[i].lower[0].template selfadjointView<Eigen::Lower>();
    y.blocks[i] = diagonal * x.blocks[i];
    for (std::size_t j = 1; j < A.rows[i].lower.size() && j <= i; ++j) {
      y.blocks[i] += A.rows[i].lower[j] * x.blocks[i - j];
      y.blocks[i - j] += A.rows[i].lower[j].transpose() * x.blocks[i];
    }
  }
  constexpr int border = System::Corner::RowsAtCompileTime;
  if constexpr (border > 0) {  // Eigen's products with zero columns dereference null pointers
    y.border = A.corner.template selfadjointView<Eigen::Lower>() * x.border;
    for (std::size_t i = 0; i < n; ++i) {
      y.blocks[i] += A.rows[i].border * x.border;
      y.border += A.rows[i].border.transpose() * x.blocks[i];
    }
  }
  return y;
}

}  // namespace splinertia::detail
