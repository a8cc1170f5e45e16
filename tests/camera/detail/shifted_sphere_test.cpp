// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/camera/detail/shifted_sphere.hpp>

#include "support/catch.hpp"

using namespace splinertia::detail;

TEST_CASE("a shifted sphere: the inverse has length 1 and the given direction") {
  for (const double xi : {-0.9, -0.2, 0.0, 0.5, 1.0, 1.7}) {
    INFO("xi " << xi);
    for (double theta = 0; theta < 3.1; theta += 0.05) {
      const Eigen::Vector3d ray(std::sin(theta), 0, std::cos(theta));
      const auto back = unshift_sphere(ray.x(), 0.0, ray.z() + xi, xi);
      if (!(ray.z() > -shifted_border(xi) + 1e-9)) continue;
      REQUIRE(back);
      CHECK((*back - ray).norm() < 1e-13);
      CHECK(std::abs(unshift_angle(std::atan2(ray.x(), ray.z() + xi), xi) - theta) < 1e-12);
    }
  }
  CHECK_FALSE(unshift_sphere(1.0, 0.0, 1.0, 2.0));   // misses the sphere: 45° > asin(1/2)
  CHECK_FALSE(unshift_sphere(0.1, 0.0, -1.0, 2.0));  // behind the centre
}
