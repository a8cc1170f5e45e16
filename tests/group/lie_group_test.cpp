// SPDX-License-Identifier: MIT
/// The concept, with a group from outside the library: the affine maps s ↦ a s + b of the line, a > 0.
#include <splinertia/group/lie_group.hpp>
#include <splinertia/group/product.hpp>

#include "group/group_laws.hpp"

namespace {

using namespace splinertia::detail;

struct Affine {
  double a = 1, b = 0;
};

/// Has all of a group but one function.
struct Unfinished {};

}  // namespace

/// Only what is demanded: no Jacobians, no increment, no adjoint_inverse.
template <>
struct splinertia::GroupTraits<Affine> {
  using Scalar = double;
  static constexpr int Dof = 2;
  static Affine identity() { return {}; }
  static Affine compose(const Affine& x, const Affine& y) { return {x.a * y.a, x.a * y.b + x.b}; }
  static Affine inverse(const Affine& x) { return {1 / x.a, -x.b / x.a}; }
  static Affine exp(const Eigen::Vector2d& tau) {
    return {std::exp(tau[0]), tau[0] == 0 ? tau[1] : std::expm1(tau[0]) / tau[0] * tau[1]};
  }
  static Eigen::Vector2d log(const Affine& x) {
    const double l = std::log(x.a);
    return {l, l == 0 ? x.b : l / std::expm1(l) * x.b};
  }
  static Eigen::Vector2d adjoint(const Affine& x, const Eigen::Vector2d& tau) {
    return {tau[0], x.a * tau[1] - x.b * tau[0]};
  }
  static Eigen::Vector2d bracket(const Eigen::Vector2d& s, const Eigen::Vector2d& t) {
    return {0, s[0] * t[1] - s[1] * t[0]};
  }
};

template <>
struct splinertia::GroupTraits<Unfinished> {
  using Scalar = double;
  static constexpr int Dof = 1;
  using Vector = Eigen::Matrix<double, 1, 1>;
  static Unfinished identity() { return {}; }
  static Unfinished compose(const Unfinished&, const Unfinished&) { return {}; }
  static Unfinished inverse(const Unfinished&) { return {}; }
  static Unfinished exp(const Vector&) { return {}; }
  static Vector adjoint(const Unfinished&, const Vector& tau) { return tau; }
  static Vector bracket(const Vector&, const Vector&) { return Vector::Zero(); }
};

/// The scale a is neither rotation nor translation; as a translation it is small enough to be told from b's rounding.
template <>
struct laws::Describe<Affine> {
  static Parts parts() { return {{}, {{1, 1}}}; }
  static Vector numbers(const Affine& x) { return Eigen::Vector2d(x.a, x.b).cast<Real>(); }
};

using splinertia::LieGroup;
using splinertia::LieGroupWithJacobians;

TEST_CASE("a group from outside needs no Jacobians", "[group]") {
  STATIC_CHECK(LieGroup<Affine>);
  STATIC_CHECK_FALSE(LieGroupWithJacobians<Affine>);
  STATIC_CHECK_FALSE(splinertia::detail::is_commutative<Affine>);  // the default
  STATIC_CHECK(splinertia::DofOf<Affine> == 2);
  STATIC_CHECK(std::is_same_v<splinertia::ScalarOf<Affine>, double>);
  laws::hold_for<Affine>();
}

TEST_CASE("increment and adjoint_inverse are made of what the group has", "[group]") {
  using T = splinertia::GroupTraits<Affine>;
  const Affine x{2, 3}, y{0.5, -1};
  const Eigen::Vector2d tau{0.25, 4};
  CHECK(splinertia::increment(x, y) == T::log(T::compose(T::inverse(x), y)));
  CHECK(splinertia::adjoint_inverse(x, tau) == T::adjoint(T::inverse(x), tau));
  CHECK((splinertia::adjoint_inverse(x, T::adjoint(x, tau)) - tau).norm() < 1e-14);
}

TEST_CASE("Ad and exp of the affine group agree in all of its tangent", "[group]") {
  using T = splinertia::GroupTraits<Affine>;
  laws::Draws draw(3);
  for (int i = 0; i < 100; ++i) {
    const Affine x = T::exp({draw(), 2 * draw()});
    const Eigen::Vector2d tau{draw(), draw()};
    const Affine left = T::compose(T::compose(x, T::exp(tau)), T::inverse(x)), right = T::exp(T::adjoint(x, tau));
    CHECK(std::abs(left.a - right.a) < 1e-13);
    CHECK(std::abs(left.b - right.b) < 1e-13);
    CHECK((T::log(T::exp(tau)) - tau).norm() < 1e-14);
  }
}

TEST_CASE("a product with it is a group without Jacobians", "[group]") {
  using P = splinertia::Product<Affine, Affine>;
  STATIC_CHECK(LieGroup<P>);
  STATIC_CHECK_FALSE(LieGroupWithJacobians<P>);
  const P x{{2, 3}, {1, 4}};
  CHECK(splinertia::increment(x, x).norm() < 1e-15);
}

TEST_CASE("what is not a group", "[group]") {
  STATIC_CHECK_FALSE(LieGroup<int>);
  STATIC_CHECK_FALSE(LieGroup<double>);  // R¹ is Matrix<double, 1, 1>
  STATIC_CHECK_FALSE(LieGroup<std::string>);
  STATIC_CHECK_FALSE(LieGroup<Unfinished>);  // no log
  STATIC_CHECK_FALSE(LieGroup<const Affine*>);
}
