// SPDX-License-Identifier: MIT
// Nothing in evaluation allocates: counted in operator new, and refused by Eigen.
#define EIGEN_RUNTIME_NO_MALLOC
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>

#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using testing::allocations, testing::allocations_of;

template <typename Curve>
std::size_t allocations_of_evaluating(const Curve& curve) {
  double sum = 0;
  const std::size_t count = allocations_of([&] {
    for (int i = 0; i <= 10; ++i) {
      const double t = curve.start() + (curve.end() - curve.start()) * i / 10;
      sum += curve.template at<3>(t).jerk.norm() + curve.template linearize<2>(t).acceleration_jacobian[0].norm();
    }
  });
  CHECK(sum > 0);
  return count;
}

TEMPLATE_TEST_CASE("Evaluating and linearizing allocate nothing", "", Sophus::SO3d, Sophus::SE2d, Sophus::SE3d,
                   SO3xR3<double>) {
  testing::Random random(1);
  const auto points = random.walk<TestType>(8);
  CHECK(allocations > 0);  // the counter counts
  CHECK(allocations_of_evaluating(Spline<TestType, 4>({.start = 0, .interval = 0.5}, points)) == 0);
  NonUniformKnots<double> knots;
  for (int i = 0; i < 12; ++i) knots.knots.push_back(i + 0.1 * (i % 3));
  CHECK(allocations_of_evaluating(Spline<TestType, 4, NonUniformKnots<double>>(knots, points)) == 0);
}
