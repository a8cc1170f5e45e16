// SPDX-License-Identifier: MIT
#include <splinertia/group/euclidean.hpp>

#include "group/group_laws.hpp"

template <typename Scalar>
using R1 = Eigen::Matrix<Scalar, 1, 1>;
template <typename Scalar>
using R3 = Eigen::Matrix<Scalar, 3, 1>;

TEMPLATE_TEST_CASE("Rⁿ is a Lie group", "[group]", float, double, long double) {
  laws::hold_for<R1<TestType>>();
  laws::hold_for<R3<TestType>>();
}

TEST_CASE("Rⁿ adds", "[group]") {
  using G = Eigen::Vector2d;
  using T = splinertia::GroupTraits<G>;
  STATIC_CHECK(splinertia::detail::is_commutative<G>);
  STATIC_CHECK(splinertia::DofOf<G> == 2);
  CHECK(T::compose(G{1, 2}, G{3, 5}) == G{4, 7});
  CHECK(T::inverse(G{1, 2}) == G{-1, -2});
  CHECK(T::increment(G{1, 2}, G{3, 5}) == G{2, 3});
  CHECK(T::bracket(G{1, 2}, G{3, 5}) == G::Zero());
}

TEST_CASE("only columns of fixed size are Rⁿ", "[group]") {
  STATIC_CHECK(splinertia::LieGroup<Eigen::Matrix<long double, 7, 1>>);
  STATIC_CHECK_FALSE(splinertia::LieGroup<Eigen::VectorXd>);     // size unknown at compile time
  STATIC_CHECK_FALSE(splinertia::LieGroup<Eigen::RowVector3d>);  // not a column
  STATIC_CHECK_FALSE(splinertia::LieGroup<Eigen::Matrix3d>);
}
