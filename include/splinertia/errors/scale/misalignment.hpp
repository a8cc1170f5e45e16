// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <splinertia/errors/error_term.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <string_view>

namespace splinertia {

/// Scale factors, non-orthogonal axes and a rotation of the sensor in its case, all in one 3×3 matrix M: the reading
/// and the bias in it are multiplied by M. The identity is a perfect sensor. See misalignment_conventions.hpp for the
/// names of its parts in data sheets and calibration programs.
template <typename Scalar = double>
struct Misalignment {
  static constexpr std::string_view name = "misalignment";
  struct State {};

  Matrix3<Scalar> matrix;

  /// Throws std::invalid_argument unless the matrix is finite and invertible: with its rows scaled to unit length, the
  /// magnitude of the determinant must exceed 8 eps, which is what rounding leaves of a singular matrix.
  Misalignment(const Matrix3<Scalar>& matrix_) : matrix(matrix_) {
    require_finite("Misalignment", "matrix", matrix);
    const auto direction = [&](int i) {
      const Vector3<Scalar> row = matrix.row(i).transpose();
      const Scalar largest = row.cwiseAbs().maxCoeff();  // divided by it, the row neither overflows nor underflows
      return Vector3<Scalar>(largest > Scalar(0) ? Vector3<Scalar>(row / largest).normalized() : row);
    };
    const Scalar determinant = direction(0).cross(direction(1)).dot(direction(2));
    using std::abs;
    require(abs(determinant) > Scalar(8) * std::numeric_limits<Scalar>::epsilon(), "Misalignment",
            "determinant of the matrix with rows of unit length", determinant, "a matrix that can be inverted");
  }

  [[gnu::always_inline]] void apply(Sample<Scalar>& sample, State&) const {
    const Vector3<Scalar> value = matrix.lazyProduct(sample.value), bias = matrix.lazyProduct(sample.bias);
    sample.value = value;
    sample.bias = bias;
  }

  void describe(auto&& parameter) const { parameter("matrix", matrix, "1"); }
};

template <typename P>
Misalignment(const P&) -> Misalignment<ScalarOfParameter<P>>;

}  // namespace splinertia
