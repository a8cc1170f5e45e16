// SPDX-License-Identifier: MIT
#include <array>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/linearize.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

using Nested = Product<Sophus::SE2d, Product<Sophus::SO2d, Eigen::Vector2d>>;

template <typename L>
concept HasVelocityJacobian = requires(L l) { l.velocity_jacobian; };
template <typename L>
concept HasAccelerationJacobian = requires(L l) { l.acceleration_jacobian; };

// A group that takes every fallback: SE(2) with no more than what LieGroupWithJacobians asks for.
struct Plain {
  Sophus::SE2d x;
};

}  // namespace

template <>
struct splinertia::GroupTraits<Plain> {
  using Base = GroupTraits<Sophus::SE2d>;
  using Scalar = double;
  using Vector = Eigen::Vector3d;
  static constexpr int Dof = 3;
  static Plain identity() { return {}; }
  static Plain compose(const Plain& a, const Plain& b) { return {Base::compose(a.x, b.x)}; }
  static Plain inverse(const Plain& a) { return {Base::inverse(a.x)}; }
  static Plain exp(const Vector& tau) { return {Base::exp(tau)}; }
  static Vector log(const Plain& a) { return Base::log(a.x); }
  static Vector adjoint(const Plain& a, const Vector& tau) { return Base::adjoint(a.x, tau); }
  static Vector bracket(const Vector& a, const Vector& b) { return Base::bracket(a, b); }
  static Eigen::Matrix3d left_jacobian(const Vector& tau) { return Base::left_jacobian(tau); }
  static Eigen::Matrix3d left_jacobian_inverse(const Vector& tau) { return Base::left_jacobian_inverse(tau); }
};

template <typename G, int Order>
void check_against_differences(double step) {
  INFO("order " << Order);
  testing::Random random(Order);
  std::vector<G> points = random.walk<G>(Order, step);
  const auto basis = uniform_basis<Order, 2>(0.37, 0.5);
  const auto at = [&] { return evaluate<2>(std::span<const G, Order>(points), basis); };
  const auto linear = linearize<2>(std::span<const G, Order>(points), basis);

  // The motion is that of evaluate(), to the last bit.
  CHECK(increment<G>(at().value, linear.value).isZero(0));
  CHECK(at().velocity == linear.velocity);
  CHECK(at().acceleration == linear.acceleration);

  const double h = 1e-5;  // second-order differences: truncation 1e-10, rounding 1e-11 of the largest entry, ~10²
  const auto largest = [](const auto& v) { return v.template lpNorm<Eigen::Infinity>(); };
  for (std::size_t i = 0; i < Order; ++i) {
    for (Eigen::Index k = 0; k < DofOf<G>; ++k) {
      const auto sides = testing::both_sides(points, i, k, h, at);
      const auto &minus = sides.first, &plus = sides.second;
      INFO("control point " << i << ", direction " << k);
      CHECK(largest(increment<G>(minus.value, plus.value) / (2 * h) - linear.value_jacobian[i].col(k)) < 1e-9);
      CHECK(largest((plus.velocity - minus.velocity) / (2 * h) - linear.velocity_jacobian[i].col(k)) < 1e-9);
      CHECK(largest((plus.acceleration - minus.acceleration) / (2 * h) - linear.acceleration_jacobian[i].col(k)) <
            1e-8);
    }
  }
}

TEMPLATE_TEST_CASE("The Jacobians of every order on every group are those of differences", "", Eigen::Vector3d,
                   Sophus::SO2d, Sophus::SO3d, Sophus::SE2d, Sophus::SE3d, SO3xR3<double>, Nested, Plain) {
  check_against_differences<TestType, 2>(0.5);
  check_against_differences<TestType, 4>(0.5);
  check_against_differences<TestType, 5>(1.2);
  check_against_differences<TestType, 8>(0.5);
}

TEST_CASE("What was not asked for does not exist") {
  STATIC_CHECK(!HasVelocityJacobian<Linearization<Sophus::SO3d, 4, 0>>);
  STATIC_CHECK(HasVelocityJacobian<Linearization<Sophus::SO3d, 4, 1>>);
  STATIC_CHECK(!HasAccelerationJacobian<Linearization<Sophus::SO3d, 4, 1>>);
  STATIC_CHECK(HasAccelerationJacobian<Linearization<Sophus::SO3d, 4, 2>>);
  STATIC_CHECK(sizeof(Linearization<Eigen::Vector3d, 4, 0>) == (3 + 4 * 9) * sizeof(double));
}

TEST_CASE("Asking for less gives the same numbers") {
  testing::Random random(1);
  const auto points = random.walk<Sophus::SE3d>(4);
  const std::span<const Sophus::SE3d, 4> span(points);
  const auto all = linearize<2>(span, uniform_basis<4, 2>(0.4, 0.1));
  const auto value = linearize<0>(span, uniform_basis<4, 0>(0.4, 0.1));
  for (std::size_t i = 0; i < 4; ++i) CHECK(value.value_jacobian[i] == all.value_jacobian[i]);
}

TEST_CASE("Moving all control points alike moves the curve alike") {
  // A perturbation X_i exp(Ad_{X_i⁻¹} ξ) is exp(ξ) X_i: it moves the value by Ad_{X⁻¹} ξ and leaves the rates.
  testing::Random random(2);
  const auto points = random.walk<Sophus::SE3d>(5);
  const auto linear = linearize<2>(std::span<const Sophus::SE3d, 5>(points), uniform_basis<5, 2>(0.7, 0.1));
  const Tangent<Sophus::SE3d> xi = random.tangent<Sophus::SE3d>();
  Tangent<Sophus::SE3d> value = -adjoint_inverse<Sophus::SE3d>(linear.value, xi), velocity, acceleration;
  velocity.setZero();
  acceleration.setZero();
  for (std::size_t i = 0; i < 5; ++i) {
    const auto delta = adjoint_inverse<Sophus::SE3d>(points[i], xi);
    value += linear.value_jacobian[i] * delta;
    velocity += linear.velocity_jacobian[i] * delta;
    acceleration += linear.acceleration_jacobian[i] * delta;
  }
  CHECK(value.norm() < 1e-14);
  CHECK(velocity.norm() < 1e-12);
  CHECK(acceleration.norm() < 1e-10);
}

TEST_CASE("A span of run-time size must be of the right one") {
  testing::Random random(3);
  const auto points = random.walk<Sophus::SO3d>(5);
  const auto basis = uniform_basis<4, 1>(0.4, 0.1);
  const std::span<const Sophus::SO3d> all(points);
  CHECK(evaluate<1>(all.first(4), basis).velocity == evaluate<1>(all.first<4>(), basis).velocity);
  CHECK(linearize<1>(all.first(4), basis).velocity_jacobian == linearize<1>(all.first<4>(), basis).velocity_jacobian);
  CHECK_THROWS_WITH(evaluate<1>(all, basis), "expected 4 control points (the order of the curve), got 5");
  CHECK_THROWS_AS(linearize<1>(all.first(3), basis), std::invalid_argument);
}
