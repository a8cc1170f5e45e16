// SPDX-License-Identifier: MIT
/// Rⁿ: Eigen's fixed-size column vectors under addition.
#pragma once

#include <splinertia/group/lie_group.hpp>

namespace splinertia {

/// The group Rⁿ. exp, log and the Adjoint are the identity, the bracket is zero.
template <typename Real, int N>
  requires(N > 0)
struct GroupTraits<Eigen::Matrix<Real, N, 1>> {
  using Scalar = Real;
  using Vector = Eigen::Matrix<Real, N, 1>;
  using Square = Eigen::Matrix<Real, N, N>;
  static constexpr int Dof = N;
  static constexpr bool commutative = true;

  static Vector identity() { return Vector::Zero(); }
  static Vector compose(const Vector& x, const Vector& y) { return x + y; }
  static Vector inverse(const Vector& x) { return -x; }
  static Vector exp(const Vector& tau) { return tau; }
  static Vector log(const Vector& x) { return x; }
  static Vector adjoint(const Vector&, const Vector& tau) { return tau; }
  static Vector bracket(const Vector&, const Vector&) { return Vector::Zero(); }
  static Vector increment(const Vector& x, const Vector& y) { return y - x; }
  static Square left_jacobian(const Vector&) { return Square::Identity(); }
  static Square left_jacobian_inverse(const Vector&) { return Square::Identity(); }
};

}  // namespace splinertia
