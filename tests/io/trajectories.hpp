// SPDX-License-Identifier: MIT
/// Poses with awkward numbers for the tests of io, and what it means that they came back.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <vector>

namespace splinertia::test {

/// Random numbers, over many orders of magnitude.
inline Eigen::Vector3d awkward_vector(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::Vector3d::NullaryExpr([&] { return uniform(random) * std::pow(10, 10 * uniform(random)); });
}

/// Poses from a slow turn, whose quaternions are continuous, at epoch times.
template <typename G = SO3xR3<double>>
std::vector<Stamped<G>> awkward_trajectory(int size) {
  std::mt19937_64 random(3);
  std::vector<Stamped<G>> poses;
  std::chrono::nanoseconds time{1403715524907143168};
  for (int i = 0; i < size; ++i) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d(1, 2, -2) / 3));
    poses.push_back({time, make_pose<G>(rotation_from_unit_quaternion<double>(q), awkward_vector(random))});
    time += std::chrono::nanoseconds{1 + static_cast<int>(random() % 10'000'000)};
  }
  return poses;
}

/// Whether two stamped poses agree in every bit (but −0 = 0).
inline bool same(const auto& a, const auto& b) {
  return a.time == b.time && position(a.value) == position(b.value) &&
         rotation(a.value).unit_quaternion().coeffs() == rotation(b.value).unit_quaternion().coeffs();
}

/// Whether two trajectories do.
inline bool same_all(const auto& a, const auto& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return same(x, y); });
}

}  // namespace splinertia::test
