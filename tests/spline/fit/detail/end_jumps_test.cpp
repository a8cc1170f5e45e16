// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <cstdint>
#include <splinertia/group/pose.hpp>
#include <splinertia/random/normal.hpp>
#include <splinertia/random/random_stream.hpp>
#include <splinertia/spline/fit/detail/end_jumps.hpp>
#include <string>
#include <utility>
#include <vector>

#include "strapdown/aggressive_motion.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using G = SO3xR3<double>;
using Poses = std::vector<Stamped<G, double>>;
using Pair = std::pair<std::size_t, std::size_t>;

/// Poses of a function of time with white noise, rad and m.
Poses poses_of(const auto& motion, double rate, int count, double noise, std::uint64_t seed = 1) {
  NormalStream normal{StreamKey(seed)};
  Poses poses;
  for (int i = 0; i < count; ++i) {
    const G value = motion(i / rate);
    Tangent<G> error;
    for (double& x : error) x = noise * normal();
    poses.push_back({i / rate, GroupTraits<G>::compose(value, GroupTraits<G>::exp(error))});
  }
  return poses;
}

G hand(double t) {
  return {Sophus::SO3d::exp({0.35 * std::sin(3.1 * t), 0.30 * std::cos(2.3 * t), 0.50 * std::sin(2.7 * t)}),
          Eigen::Vector3d(0.25 * std::sin(2.1 * t), 0.20 * std::cos(1.7 * t), 1.2)};
}

G still(double) { return {Sophus::SO3d::exp({0.3, 1, -0.7}), Eigen::Vector3d(1, -2, 0.5)}; }

G retracted(const G& pose, const Eigen::Vector3d& by) { return {pose.get<0>(), Eigen::Vector3d(pose.get<1>() + by)}; }

}  // namespace

TEST_CASE("Poses of identity at the start are beyond the jump") {
  for (const std::size_t identities : {1U, 2U, 5U, 16U}) {
    for (const double noise : {0., 1e-6, 1e-3}) {
      auto poses = poses_of(hand, 100, 300, noise);
      for (std::size_t i = 0; i < identities; ++i) poses[i].value = G();
      CHECK(poses_between_jumps(poses) == Pair{identities, 299});
    }
  }
  auto steady = poses_of(still, 20, 100, 1e-3);
  steady[0].value = steady[1].value = G();
  CHECK(poses_between_jumps(steady) == Pair{2, 99});
  // More than that is a part of its own.
  auto many = poses_of(hand, 100, 300, 1e-3);
  for (std::size_t i = 0; i < 40; ++i) many[i].value = G();
  CHECK(poses_between_jumps(many) == Pair{0, 299});
}

TEST_CASE("Wrong poses at the end are beyond the jump") {
  for (const std::size_t wrong : {1U, 2U, 3U}) {
    auto poses = poses_of(hand, 30, 200, 0.01);
    for (std::size_t i = 200 - wrong; i < 200; ++i) {
      const double k = static_cast<double>(i);
      poses[i].value = retracted(poses[i].value, {6 * std::cos(k), 6 * std::sin(k), 1});
    }
    CHECK(poses_between_jumps(poses) == Pair{0, 199 - wrong});
  }
  auto turned = poses_of(hand, 30, 200, 1e-3);
  turned.back().value.get<0>() *= Sophus::SO3d::rotX(2.5);
  CHECK(poses_between_jumps(turned) == Pair{0, 198});
  auto both = poses_of(hand, 30, 200, 1e-3);
  both.front().value = G();
  both.back().value = retracted(both.back().value, {0, 3, 0});
  CHECK(poses_between_jumps(both) == Pair{1, 198});
}

TEST_CASE("Motions are no jumps") {
  const testing::AggressiveMotion<> aggressive;
  const auto thrown = [&](double t) { return aggressive.evaluate<0>(t).value; };
  const auto circle = [](double t) {
    return G{Sophus::SO3d::rotZ(13 * t), Eigen::Vector3d(std::cos(13 * t), std::sin(13 * t), 1)};
  };
  // Starts and stops: 5 m/s² from rest, in the last 0.3 s; a blow of 30 m/s² for 20 ms at the end.
  const auto start = [](double t) {
    const double s = std::max(0., t - 2.7);
    return retracted(still(t), {2.5 * s * s, 0, 0});
  };
  // At a steady speed and turn, from rest.
  const auto drive = [](double t) {
    const double s = std::max(0., t - 2.8);
    return G{Sophus::SO3d::rotZ(2 * s), Eigen::Vector3d(1.5 * s, 0, 0)};
  };
  const auto blow = [](double t) {
    const double s = std::max(0., t - 2.98);
    return retracted(still(t), {0, 0, 15 * s * s});
  };
  for (const double noise : {0., 1e-5, 1e-3, 1e-2}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      for (const double rate : {20., 100.}) {
        const auto count = static_cast<int>(3 * rate) + 1;
        const Pair all{0, count - 1};
        INFO("noise " << noise << ", seed " << seed << ", rate " << rate);
        CHECK(poses_between_jumps(poses_of(hand, rate, count, noise, seed)) == all);
        CHECK(poses_between_jumps(poses_of(still, rate, count, noise, seed)) == all);
        CHECK(poses_between_jumps(poses_of(thrown, rate, count, noise, seed)) == all);
        CHECK(poses_between_jumps(poses_of(circle, rate, count, noise, seed)) == all);
        CHECK(poses_between_jumps(poses_of(drive, rate, count, noise, seed)) == all);
        // Beside a rest without noise, what begins fewer than nine poses before the end is a jump.
        if (noise < 1e-3 && rate < 100) continue;
        CHECK(poses_between_jumps(poses_of(start, rate, count, noise, seed)) == all);
        if (noise < 1e-3) continue;
        CHECK(poses_between_jumps(poses_of(blow, rate, count, noise, seed)) == all);
      }
    }
  }
}

TEST_CASE("Jumps in the middle, and outliers there, are not of the ends") {
  auto poses = poses_of(hand, 100, 300, 1e-3);
  for (std::size_t i = 150; i < 300; ++i) poses[i].value = retracted(poses[i].value, {1, 0, 0});
  CHECK(poses_between_jumps(poses) == Pair{0, 299});
  for (std::size_t i = 30; i < 270; i += 97) poses[i].value = retracted(poses[i].value, {0, 5, 0});
  CHECK(poses_between_jumps(poses) == Pair{0, 299});
}

TEST_CASE("Uneven stamps and holes are no jumps") {
  auto poses = poses_of(hand, 100, 600, 1e-4);
  std::erase_if(poses, [](const auto& pose) { return pose.time > 0.095 && pose.time < 0.595; });
  std::erase_if(poses, [](const auto& pose) { return pose.time > 2 && std::fmod(pose.time, 0.07) < 0.02; });
  CHECK(poses_between_jumps(poses) == Pair{0, poses.size() - 1});
}

TEST_CASE("Few poses have no ends to lose") {
  for (int count = 2; count < 8; ++count) {
    auto poses = poses_of(hand, 100, count, 0);
    poses.back().value = retracted(poses.back().value, {6, 0, 0});
    CHECK(poses_between_jumps(poses) == Pair{0, static_cast<std::size_t>(count) - 1});
  }
  auto eight = poses_of(hand, 100, 8, 0);
  eight.back().value = retracted(eight.back().value, {6, 0, 0});
  CHECK(poses_between_jumps(eight) == Pair{0, 6});
  CHECK(poses_between_jumps(poses_of(still, 100, 50, 0)) == Pair{0, 49});
}

TEMPLATE_TEST_CASE("On every group, and on integer time since an epoch", "[group]", Eigen::Vector3d, Sophus::SO3d,
                   Sophus::SE2d, Sophus::SE3d, SO3xR3<float>) {
  using H = TestType;
  using Scalar = ScalarOf<H>;
  NormalStream normal{StreamKey(9)};
  std::vector<Stamped<H, nanoseconds>> poses;
  const nanoseconds epoch{1'403'715'524'907'143'168};
  for (int i = 0; i < 200; ++i) {
    Tangent<H> way;
    for (int row = 0; row < way.size(); ++row) {
      way[row] = static_cast<Scalar>(0.3 * std::sin(0.02 * i * (row + 1)) + 1e-3 * normal());
    }
    poses.push_back({epoch + i * nanoseconds(10'000'000), GroupTraits<H>::exp(way)});
  }
  CHECK(poses_between_jumps(poses) == Pair{0, 199});
  for (int i = 0; i < 3; ++i) {
    poses[static_cast<std::size_t>(i)].value = GroupTraits<H>::compose(
        poses[static_cast<std::size_t>(i)].value, GroupTraits<H>::exp(Tangent<H>(Tangent<H>::Constant(Scalar(1)))));
  }
  CHECK(poses_between_jumps(poses) == Pair{3, 199});
}
