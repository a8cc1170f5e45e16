// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <splinertia/detail/inline.hpp>
#include <splinertia/errors/detail/determinant.hpp>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Scale factors, non-orthogonal axes and a rotation of the sensor in its case, all in one square matrix M with a row
/// for each axis: the reading and the bias in it are multiplied by M. The identity is a perfect sensor. See misalignment_conventions.hpp for the
/// names of its parts in data sheets and calibration programs.
template <typename Scalar = double, int N = 3>
struct Misalignment {
  static constexpr std::string_view name = "misalignment";
  struct State {};

  using Matrix = Eigen::Matrix<Scalar, N, N>;
  Matrix matrix;

  /// Throws std::invalid_argument unless the elements and their third powers are finite and the matrix is invertible: with
  /// its rows scaled to unit length, the magnitude of the determinant must exceed 8 eps, which is what rounding leaves of
  /// a singular matrix.
  Misalignment(const Matrix& matrix_) : matrix(matrix_) {
    detail::require_factor("Misalignment", "matrix", matrix);
    Matrix directions = matrix;
    for (int i = 0; i < N; ++i) {
      const Scalar largest = matrix.row(i).cwiseAbs().maxCoeff();
      if (!(largest > Scalar(0))) continue;
      directions.row(i) /= largest;  // so that the row neither overflows nor underflows
      directions.row(i).normalize();
    }
    const Scalar determinant = detail::determinant_of(directions);
    using std::abs;
    detail::require(abs(determinant) > Scalar(8) * std::numeric_limits<Scalar>::epsilon(), "Misalignment",
                    "determinant of the matrix with rows of unit length", determinant, "a matrix that can be inverted");
  }

  SPLINERTIA_ALWAYS_INLINE void apply(SensorSample<Scalar, N>& sample, State&) const {
    const AxisVector<Scalar, N> value = matrix.lazyProduct(sample.value), bias = matrix.lazyProduct(sample.bias);
    sample.value = value;
    sample.bias = bias;
  }

  void describe(auto&& parameter) const { parameter("matrix", matrix, "1"); }
};

template <typename P>
Misalignment(const P&)
    -> Misalignment<detail::ScalarOfParameter<P>, detail::checked_size<static_cast<int>(P::RowsAtCompileTime)>()>;

}  // namespace splinertia
