// SPDX-License-Identifier: MIT
#include <splinertia/group/euclidean.hpp>
#include <splinertia/group/product.hpp>
#include <splinertia/group/sophus.hpp>

#include "group/sophus_laws.hpp"

using splinertia::GroupTraits;
using splinertia::Product;
using splinertia::SO3xR3;

template <typename Scalar>
using Nested = Product<Sophus::SE2<Scalar>, SO3xR3<Scalar>, Eigen::Matrix<Scalar, 1, 1>>;

TEMPLATE_TEST_CASE("a product of products is a Lie group", "[group]", float, double) {
  laws::hold_for<Nested<TestType>>();
}

TEST_CASE("a product knows its factors", "[group]") {
  using P = Nested<double>;
  STATIC_CHECK(P::size == 3);
  STATIC_CHECK(splinertia::DofOf<P> == 10);
  STATIC_CHECK(P::offset<0> == 0);
  STATIC_CHECK(P::offset<1> == 3);
  STATIC_CHECK(P::offset<2> == 9);
  STATIC_CHECK(std::is_same_v<P::Factor<1>, SO3xR3<double>>);
  STATIC_CHECK_FALSE(splinertia::detail::is_commutative<P>);
  STATIC_CHECK(splinertia::detail::is_commutative<Product<Sophus::SO2d, Eigen::Vector3d>>);
}

TEST_CASE("factors are read, written and bound by name", "[group]") {
  SO3xR3<double> x;
  CHECK(x.get<0>().unit_quaternion().coeffs() == Eigen::Quaterniond::Identity().coeffs());
  CHECK(x.get<1>() == Eigen::Vector3d::Zero());
  x.get<1>() = {1, 2, 3};
  const auto& [R, p] = x;
  CHECK(p == Eigen::Vector3d{1, 2, 3});
  CHECK(&R == &x.get<0>());
}

TEST_CASE("tangents are those of the factors, in their order", "[group]") {
  using P = SO3xR3<double>;
  using T = GroupTraits<P>;
  Eigen::Matrix<double, 6, 1> tau;
  tau << 0.1, -0.2, 0.3, 4, 5, 6;
  const P x = T::exp(tau);
  CHECK(x.get<0>().unit_quaternion().coeffs() ==
        GroupTraits<Sophus::SO3d>::exp(tau.head<3>()).unit_quaternion().coeffs());
  CHECK(x.get<1>() == tau.tail<3>());
  CHECK(T::part<1>(tau) == tau.tail<3>());
  const auto J = splinertia::left_jacobian<P>(tau);
  CHECK(J.topRightCorner<3, 3>() == Eigen::Matrix3d::Zero());
  CHECK(J.bottomLeftCorner<3, 3>() == Eigen::Matrix3d::Zero());
  CHECK(J.bottomRightCorner<3, 3>() == Eigen::Matrix3d::Identity());
}

TEST_CASE("factors of a product have one scalar", "[group]") {
  STATIC_CHECK_FALSE(splinertia::LieGroup<Product<Sophus::SO3f, Eigen::Vector3d>>);
}
