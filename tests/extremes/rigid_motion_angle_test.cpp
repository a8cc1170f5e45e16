// SPDX-License-Identifier: MIT
/// Increments of every angle from 0 to next to π, on groups where rotations move the translation.
/// golden/se3_spline.csv (classes ang:*) holds long double to the same ladder.
#include "angle_ladder.hpp"

using namespace splinertia;
using namespace extremes;

TEMPLATE_TEST_CASE("Every angle, from 0 to next to pi", "", Sophus::SE2f, Sophus::SE2d, Sophus::SE3f, Sophus::SE3d,
                   Sophus::SE3<long double>) {
  check_every_angle<TestType>();
}
