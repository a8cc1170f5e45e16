// SPDX-License-Identifier: MIT
#include <iostream>
#include <splinertia/splinertia.hpp>
#include <vector>

using namespace splinertia;

int main() {
  using Pose = SO3xR3<double>;
  const Pose pose = GroupTraits<Pose>::identity();
  std::cout << "splinertia works: log(identity) = " << GroupTraits<Pose>::log(pose).transpose() << "\n";

  // At rest, and so it stays.
  const Spline<Pose, 4> curve({.start = 0, .interval = 0.5}, std::vector<Pose>(7, pose));
  const auto imu = simulate(curve, Imu{ErrorModel{WhiteNoise{0.0}}, ErrorModel{}}, {.rate = 100});
  const auto states = integrate<Midpoint>(nav_state(curve.evaluate<1>(0), 0.0), imu);
  std::cout << states.size() << " states, " << (states.back().p_WB.norm() < 1e-12 ? "at rest\n" : "moved\n");
}
