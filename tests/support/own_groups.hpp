// SPDX-License-Identifier: MIT
/// Groups that the library does not know: what a user has adapted, with as much as is asked for and no more.
#pragma once

#include <cmath>
#include <splinertia/group/lie_group.hpp>

namespace test {

using namespace splinertia::detail;

/// Positive factors under multiplication. Evaluates, and has Jacobians.
struct Gain {
  double factor = 1;
};

/// The same without Jacobians.
struct PlainGain {
  double factor = 1;
};

template <typename G>
struct GainTraits {
  using Scalar = double;
  using Vector = Eigen::Matrix<double, 1, 1>;
  static constexpr int Dof = 1;
  static constexpr bool commutative = true;
  static G identity() { return {}; }
  static G compose(const G& x, const G& y) { return {x.factor * y.factor}; }
  static G inverse(const G& x) { return {1 / x.factor}; }
  static G exp(const Vector& tau) { return {std::exp(tau[0])}; }
  static Vector log(const G& x) { return Vector(std::log(x.factor)); }
  static Vector adjoint(const G&, const Vector& tau) { return tau; }
  static Vector bracket(const Vector&, const Vector&) { return Vector::Zero(); }
};

/// A number under addition, over any scalar, with its numbers known: it goes in lanes and in parameter blocks.
template <typename Scalar>
struct Shift {
  Scalar by{0};
};

}  // namespace test

template <>
struct splinertia::GroupTraits<test::PlainGain> : test::GainTraits<test::PlainGain> {};

template <>
struct splinertia::GroupTraits<test::Gain> : test::GainTraits<test::Gain> {
  static Vector left_jacobian(const Vector&) { return Vector::Ones(); }
  static Vector left_jacobian_inverse(const Vector&) { return Vector::Ones(); }
};

template <typename S>
struct splinertia::GroupTraits<test::Shift<S>> {
  using Scalar = S;
  using G = test::Shift<S>;
  using Vector = Eigen::Matrix<S, 1, 1>;
  static constexpr int Dof = 1;
  static constexpr bool commutative = true;
  static G identity() { return {}; }
  static G compose(const G& x, const G& y) { return {x.by + y.by}; }
  static G inverse(const G& x) { return {-x.by}; }
  static G exp(const Vector& tau) { return {tau[0]}; }
  static Vector log(const G& x) { return Vector(x.by); }
  static Vector adjoint(const G&, const Vector& tau) { return tau; }
  static Vector bracket(const Vector&, const Vector&) { return Vector::Zero(); }
  static Vector left_jacobian(const Vector&) { return Vector::Ones(); }
  static Vector left_jacobian_inverse(const Vector&) { return Vector::Ones(); }
};
