// SPDX-License-Identifier: MIT
/// Increments of every angle from 0 to π, on groups where rotations turn nothing else. golden/so3_spline.csv (classes
/// ang:*) holds long double to the same ladder.
#include "angle_ladder.hpp"

using namespace splinertia;
using namespace extremes;

TEMPLATE_TEST_CASE("Every angle, from 0 to next to pi", "", Sophus::SO2f, Sophus::SO2d, Sophus::SO3f, Sophus::SO3d,
                   Sophus::SO3<long double>, SO3xR3<float>, SO3xR3<double>) {
  check_every_angle<TestType>();
}
