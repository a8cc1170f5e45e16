// SPDX-License-Identifier: MIT
#include "jacobian_ladder.hpp"

using namespace extremes;

TEST_CASE("Jacobians on SE(3) at every angle, from 0 to next to pi") {
  check_jacobians_at_every_angle<Sophus::SE3d, 2, 4>();
}
