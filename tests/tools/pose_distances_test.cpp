// SPDX-License-Identifier: MIT
#include "../../tools/support/pose_distances.hpp"

#include <splinertia/splinertia.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

Poses at_rest(std::size_t count) {
  Poses poses;
  for (std::size_t i = 0; i < count; ++i)
    poses.push_back({nanoseconds(10000000LL * static_cast<long long>(i)), SO3xR3<double>{}});
  return poses;
}

}  // namespace

TEST_CASE("distances are curve minus pose, in the world and in the body of the pose") {
  Poses poses = at_rest(2), curve = at_rest(2);
  poses[1].value = SO3xR3<double>{Sophus::SO3d::rotZ(1), Eigen::Vector3d(1, 2, 3)};
  curve[1].value = SO3xR3<double>{Sophus::SO3d::rotZ(1) * Sophus::SO3d::rotX(0.1), Eigen::Vector3d(1, 2, 4)};
  const PoseDistances off = distances(curve, poses);
  CHECK(off.position[0].norm() == 0);
  CHECK((off.position[1] - Eigen::Vector3d(0, 0, 1)).norm() < 1e-15);
  CHECK((off.rotation[1] - Eigen::Vector3d(0.1, 0, 0)).norm() < 1e-15);
  const Lengths all = lengths(off.position), inner = lengths(off.position, {1});
  CHECK(all.max == 1);
  CHECK(std::abs(all.rms - std::sqrt(0.5)) < 1e-15);
  CHECK(inner.max == 0);
}

TEST_CASE("outliers near each other are one run, and of many runs the worst are named") {
  const Poses poses = at_rest(100);
  PoseDistances off = distances(poses, poses);
  for (const std::size_t i : {10u, 12u, 50u, 90u}) off.position[i] = Eigen::Vector3d(0, 0, static_cast<double>(i));
  const std::vector<std::size_t> outliers{10, 12, 50, 90};
  CHECK(outlier_lines(poses, off, outliers, 3) ==
        std::vector<std::string>{"0.100 - 0.120 s (2 poses, up to 12 m, 0 rad)", "0.500 s (1 pose, up to 50 m, 0 rad)",
                                 "0.900 s (1 pose, up to 90 m, 0 rad)"});
  const auto worst = outlier_lines(poses, off, outliers, 1);
  REQUIRE(worst.size() == 2);
  CHECK(worst[0] == "0.900 s (1 pose, up to 90 m, 0 rad)");
  CHECK(worst[1] == "and in 2 more runs with smaller deviations");
}

TEST_CASE("the longest interval") {
  Poses poses = at_rest(10);
  poses.erase(poses.begin() + 3, poses.begin() + 5);
  CHECK(longest_interval(poses) == nanoseconds(30'000'000));
  CHECK(longest_interval({}) == nanoseconds(0));
}
