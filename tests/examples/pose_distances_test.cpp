// SPDX-License-Identifier: MIT
#include "../../examples/support/pose_distances.hpp"

#include <random>
#include <splinertia/splinertia.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

Poses shaken(double rotation, double position, double noisy_axes = 3) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  Poses poses;
  for (int i = 0; i < 2000; ++i) {
    const auto pose = Ellipse<>{}.evaluate<0>(0.005 * i).value;
    Eigen::Vector3d turn, step;
    for (int axis = 0; axis < 3; ++axis) {
      turn[axis] = axis < noisy_axes ? rotation * normal(random) : 0;
      step[axis] = axis < noisy_axes ? position * normal(random) : 0;
    }
    poses.push_back({nanoseconds(5'000'000LL * i), SO3xR3<double>{splinertia::rotation(pose) * Sophus::SO3d::exp(turn),
                                                                  Eigen::Vector3d(splinertia::position(pose) + step)}});
  }
  return poses;
}

}  // namespace

TEST_CASE("the noise of poses is found on a moving body, also where only one axis is noisy") {
  for (const double axes : {3.0, 1.0}) {
    const PoseNoise noise = pose_noise(shaken(1e-3, 2e-3, axes));
    CHECK(noise.rotation > 0.9e-3);
    CHECK(noise.rotation < 1.15e-3);
    CHECK(noise.position > 1.8e-3);
    CHECK(noise.position < 2.3e-3);
  }
}

TEST_CASE("exact and few poses have no noise") {
  Poses poses = shaken(0, 0);
  CHECK(pose_noise(poses).rotation < 1e-12);
  CHECK(pose_noise(poses).position < 1e-11);
  poses = shaken(1, 1);
  poses.resize(6);
  CHECK(pose_noise(poses).position == 0);
  CHECK(pose_noise({}).rotation == 0);
}

TEST_CASE("the median interval does not see a hole, the longest is it") {
  Poses poses = shaken(0, 0);
  poses.erase(poses.begin() + 100, poses.begin() + 300);
  CHECK(median_interval(poses) == nanoseconds(5'000'000));
  CHECK(longest_interval(poses) == nanoseconds(1'005'000'000));
  CHECK(median_interval({}) == nanoseconds(0));
}
