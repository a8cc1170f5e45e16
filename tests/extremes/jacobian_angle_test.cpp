// SPDX-License-Identifier: MIT
#include "jacobian_ladder.hpp"

using namespace splinertia;
using namespace extremes;

TEMPLATE_TEST_CASE("Jacobians at every angle, from 0 to next to pi", "", Sophus::SO3f, Sophus::SO3d) {
  check_jacobians_at_every_angle<TestType, 2, 3, 4, 6>();
}

TEST_CASE("Jacobians at exactly pi are finite, and those of the increment that was taken") {
  using G = Sophus::SO3d;
  std::vector<G> points;
  for (const auto& q : {Eigen::Quaterniond{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}}) {
    points.push_back(rotation_from_unit_quaternion<double>(q));
  }
  WorstJacobians worst;
  for (const double u : {0.0, 0.3, 0.5, 1.0}) compare_jacobians<4>(worst, points, u);
  CHECK(worst.value <= jacobian_limit);
  CHECK(worst.velocity <= jacobian_limit);
  CHECK(worst.acceleration <= jacobian_limit);
}
