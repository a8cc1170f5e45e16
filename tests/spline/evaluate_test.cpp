// SPDX-License-Identifier: MIT
#include <array>
#include <limits>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/evaluate.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/catch.hpp"
#include "support/derivatives.hpp"
#include "support/random_group.hpp"

using namespace splinertia;

namespace {

using Nested = Product<Sophus::SE2d, Product<Sophus::SO2d, Eigen::Vector2d>>;

template <typename G>
double largest(const Tangent<G>& v) {
  return v.template lpNorm<Eigen::Infinity>();
}

template <int Order, typename G>
void check_order() {
  INFO("order " << Order);
  testing::Random random(Order);
  const Spline<G, Order> curve({.start = 10, .interval = 0.5}, random.walk<G>(Order + 5));

  // Six-point differences inside a segment; order 8 has derivatives up to 1e3, hence the relative bounds.
  const double t = 11.2;
  const auto errors = testing::derivative_errors<3>(curve, t, 4e-3);
  const auto m = curve.template evaluate<3>(t);
  CHECK(errors[0] < 1e-10 * (1 + largest<G>(m.velocity)));
  CHECK(errors[1] < 1e-9 * (1 + largest<G>(m.acceleration)));
  CHECK(errors[2] < 1e-8 * (1 + largest<G>(m.jerk)));

  // Asking for less gives the same numbers.
  CHECK(curve.template evaluate<2>(t).acceleration == m.acceleration);
  CHECK(curve.template evaluate<1>(t).velocity == m.velocity);
  CHECK(increment<G>(curve.template evaluate<0>(t).value, m.value).isZero(0));

  // So does owning the control points oneself.
  const auto [first, basis] = curve.knots().template basis<double, Order, 3>(t, curve.control_points().size());
  const std::span<const G, Order> points(curve.control_points().data() + first, Order);
  const auto own = evaluate<3>(points, basis);
  CHECK(own.jerk == m.jerk);
  CHECK(increment<G>(own.value, m.value).isZero(0));
}

}  // namespace

TEMPLATE_TEST_CASE("Every order on every group has the derivatives of its value", "", Eigen::Vector3d, Sophus::SO2d,
                   Sophus::SO3d, Sophus::SE2d, Sophus::SE3d, SO3xR3<double>, Nested) {
  check_order<2, TestType>();
  check_order<3, TestType>();
  check_order<4, TestType>();
  check_order<5, TestType>();
  check_order<6, TestType>();
  check_order<7, TestType>();
  check_order<8, TestType>();
}

// A cumulative spline through points of a one-parameter subgroup is that subgroup: rest and constant twist are exact.
TEMPLATE_TEST_CASE("Rest and constant twist are reproduced to rounding", "", Sophus::SO3d, Sophus::SE3d,
                   SO3xR3<double>) {
  using G = TestType;
  testing::Random random(7);
  const G initial = random.walk<G>(1)[0];
  for (const double speed : {0.0, 1e-9, 1e-3, 2.0}) {
    const Tangent<G> twist = random.tangent<G>(speed);
    std::vector<G> points;
    for (int i = 0; i < 12; ++i) {
      points.push_back(GroupTraits<G>::compose(initial, GroupTraits<G>::exp(twist * (0.5 * i))));
    }
    const Spline<G, 4> curve({.start = 0.5, .interval = 0.5}, points);  // control point i belongs to i · 0.5
    for (const double t : {0.5, 0.6, 2.75, 5.0}) {
      const auto m = curve.template evaluate<2>(t);
      const G expected = GroupTraits<G>::compose(initial, GroupTraits<G>::exp(twist * t));
      // The points themselves are rounded, by eps of their size, which the interval and its square divide.
      const double rounding = 8 * std::numeric_limits<double>::epsilon() * (4 + 6 * speed);
      CHECK(increment<G>(expected, m.value).norm() < rounding);
      CHECK((m.velocity - twist).norm() < rounding / 0.5);
      CHECK(m.acceleration.norm() < rounding / 0.25);
      if (speed == 0.0) {
        CHECK(m.velocity.isZero(0));
        CHECK(m.acceleration.isZero(0));
      }
    }
  }
}

TEST_CASE("The value is that of the textbook's product of exponentials") {
  using G = Sophus::SE3d;
  testing::Random random(9);
  const auto x = random.walk<G>(4);
  const double u = 0.3;
  const auto basis = uniform_basis<4, 0>(u, 1.0);
  G expected = x[0];
  const double lambda[] = {(5 + 3 * u - 3 * u * u + u * u * u) / 6, (1 + 3 * u + 3 * u * u - 2 * u * u * u) / 6,
                           u * u * u / 6};
  for (std::size_t j = 0; j < 3; ++j) expected = expected * G::exp(lambda[j] * (x[j].inverse() * x[j + 1]).log());
  CHECK((evaluate<0>(std::span<const G, 4>(x), basis).value.matrix() - expected.matrix()).norm() < 1e-14);
}
