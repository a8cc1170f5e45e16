// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/detail/rotation.hpp>

namespace splinertia::detail {

/// The 6 × 6 matrix [A B; 0 A], stored as the dual number A + εB with ε² = 0. Every Adjoint, bracket and Jacobian of
/// SE(3) on [translation; rotation] has this form, because SE(3) is SO(3) over the dual numbers. A product costs three
/// 3 × 3 products instead of eight.
template <typename Scalar>
struct DualMatrix3 {
  Eigen::Matrix3<Scalar> real;  ///< A
  Eigen::Matrix3<Scalar> dual;  ///< B

  [[nodiscard]] static DualMatrix3 identity() {
    return {Eigen::Matrix3<Scalar>::Identity(), Eigen::Matrix3<Scalar>::Zero()};
  }

  [[nodiscard]] DualMatrix3 operator*(const DualMatrix3& other) const {
    return {real * other.real, real * other.dual + dual * other.real};
  }
  [[nodiscard]] DualMatrix3 operator+(const DualMatrix3& other) const { return {real + other.real, dual + other.dual}; }
  [[nodiscard]] DualMatrix3 operator-(const DualMatrix3& other) const { return {real - other.real, dual - other.dual}; }
  [[nodiscard]] friend DualMatrix3 operator*(const Scalar& s, const DualMatrix3& m) { return {s * m.real, s * m.dual}; }

  /// The full 6 × 6 matrix.
  operator Eigen::Matrix<Scalar, 6, 6>() const {
    Eigen::Matrix<Scalar, 6, 6> m;
    m.template block<3, 3>(0, 0) = real;
    m.template block<3, 3>(0, 3) = dual;
    m.template block<3, 3>(3, 0).setZero();
    m.template block<3, 3>(3, 3) = real;
    return m;
  }
};

}  // namespace splinertia::detail
