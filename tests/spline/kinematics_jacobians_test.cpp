// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <span>
#include <splinertia/spline/evaluate.hpp>
#include <splinertia/spline/kinematics_jacobians.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

namespace {

template <typename G, int Order>
void check_against_differences() {
  INFO("order " << Order);
  using Scalar = ScalarOf<G>;
  testing::Random random(Order);
  std::vector<G> points = random.walk<G>(Order);
  const auto basis = uniform_basis<Order, 2>(Scalar(37) / 100, Scalar(1) / 2);
  const Eigen::Vector3<Scalar> gravity(Scalar(0.7), Scalar(-1.5), Scalar(-9.5));
  const auto at = [&] { return evaluate<2>(std::span<const G, Order>(points), basis); };
  const auto linear = linearize<2>(std::span<const G, Order>(points), basis);
  const Eigen::Vector3<Scalar> force = specific_force(linear, gravity);

  // Central differences: of derivatives of the size of 100, h²/6 of them is cut off and ε/h rounded, least for this h.
  const Scalar h = std::cbrt(std::numeric_limits<Scalar>::epsilon()), bound = 100 * h * h;
  const auto largest = [](const auto& v) { return v.template lpNorm<Eigen::Infinity>(); };
  for (std::size_t i = 0; i < Order; ++i) {
    for (Eigen::Index k = 0; k < DofOf<G>; ++k) {
      INFO("control point " << i << ", direction " << k);
      const auto sides = testing::both_sides(points, i, k, h, at);
      const auto &minus = sides.first, &plus = sides.second;
      const auto difference = [&](const auto& f) { return Eigen::Vector3<Scalar>((f(plus) - f(minus)) / (2 * h)); };
      const auto omega = difference([](const auto& m) { return angular_velocity(m); });
      const auto alpha = difference([](const auto& m) { return angular_acceleration(m); });
      const auto f = difference([&](const auto& m) { return specific_force(m, gravity); });
      CHECK(largest(angular_velocity_jacobian(linear, i).col(k) - omega) < bound);
      CHECK(largest(angular_acceleration_jacobian(linear, i).col(k) - alpha) < 10 * bound);
      CHECK(largest(specific_force_jacobian(linear, i, force, gravity).col(k) - f) < 10 * bound);
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE(
    "The Jacobians of angular velocity, angular acceleration and specific force are those of differences", "",
    SO3xR3<double>, Sophus::SE3d, SO3xR3<long double>, Sophus::SE3<long double>) {
  check_against_differences<TestType, 4>();
  check_against_differences<TestType, 5>();
  check_against_differences<TestType, 6>();
}
