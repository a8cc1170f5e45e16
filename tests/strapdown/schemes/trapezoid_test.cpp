// SPDX-License-Identifier: MIT
#include <splinertia/strapdown/schemes/trapezoid.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEST_CASE("The trapezoid converges with order 2") {
  testing::check_order<Trapezoid>(2, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<Trapezoid>(2);
  CHECK(testing::aggressive_error<Trapezoid>(testing::regular_stamps(200)) < 0.85);
}

TEST_CASE("A step of the trapezoid is the mean of both accelerations, each in its own axes") {
  using Sample = ImuSample<>;
  const std::array<Sample, 2> window{Sample{1, {0, 0, 1}, {2, 0, 0}}, Sample{1.5, {0, 0, 3}, {0, 4, 0}}};
  const auto step = step_increment<Trapezoid, double>(window, 0);
  CHECK(step.interval == 0.5);
  const double c = std::cos(1.0), s = std::sin(1.0);  // the mean rate 2 rad/s over 0.5 s
  CHECK((step.velocity - Eigen::Vector3d(2 - 4 * s, 4 * c, 0) / 4).norm() < 1e-15);
  CHECK((step.position - step.velocity / 4).norm() < 1e-15);
  CHECK_THAT(step.rotation.w(), WithinAbs(std::cos(0.5), 1e-16));
}
