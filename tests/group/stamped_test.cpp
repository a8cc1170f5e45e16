// SPDX-License-Identifier: MIT
#include <list>
#include <span>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/group/stamped.hpp>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"

using splinertia::Stamped;

TEST_CASE("a stamped element is a time and a value", "[group]") {
  using namespace std::chrono_literals;
  const Stamped<Eigen::Vector3d> line{.time = 1403636579763555584ns, .value = {1, 2, 3}};
  CHECK(line.time.count() == 1403636579763555584);  // an epoch stamp, to the nanosecond
  CHECK(line.value == Eigen::Vector3d{1, 2, 3});

  const Stamped<Eigen::Vector3d, double> seconds{.time = 0.25, .value = {1, 2, 3}};
  CHECK(seconds.time == 0.25);
  STATIC_CHECK(std::is_aggregate_v<Stamped<Eigen::Vector3d, double>>);
}

TEST_CASE("a range of stamped elements, or of what derives from them, is a trajectory", "[group]") {
  using Line = Stamped<Eigen::Vector3d>;
  struct More : Line {
    double temperature;
  };
  STATIC_CHECK(splinertia::detail::StampedPoses<std::vector<Line>>);
  STATIC_CHECK(splinertia::detail::StampedPoses<std::span<const More>>);
  STATIC_CHECK_FALSE(splinertia::detail::StampedPoses<std::list<Line>>);
  STATIC_CHECK_FALSE(splinertia::detail::StampedPoses<std::vector<Eigen::Vector3d>>);
  STATIC_CHECK(std::is_same_v<splinertia::detail::GroupOf<More>, Eigen::Vector3d>);
}
