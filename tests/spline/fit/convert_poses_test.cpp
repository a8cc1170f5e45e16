// SPDX-License-Identifier: MIT
#include <chrono>
#include <limits>
#include <splinertia/group/pose.hpp>
#include <splinertia/spline/fit/convert_poses.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"

using namespace splinertia;
using splinertia::testing::message_of;

namespace {

using Poses = std::vector<Stamped<SO3xR3<double>, double>>;
using Nanoseconds = UniformKnots<std::chrono::nanoseconds>;
using Same = Spline<SO3xR3<double>, 4>;
using Joint = Spline<Sophus::SE3d, 4, Nanoseconds>;

Poses two_poses() {
  return {{1.0, {Sophus::SO3d::exp({0.1, 0.2, 0.3}), {1, 2, 3}}}, {1.5, {Sophus::SO3d::exp({0.3, 0, 0}), {4, 5, 6}}}};
}

}  // namespace

TEST_CASE("Poses are converted to the group and the time type of the curve") {
  const Poses poses = two_poses();
  const auto converted = convert_poses<Joint>(poses, "test");
  REQUIRE(converted.size() == 2);
  CHECK(converted[1].time == std::chrono::milliseconds(1500));
  CHECK((converted[0].value.translation() - Eigen::Vector3d(1, 2, 3)).norm() == 0);
  CHECK((converted[0].value.so3().inverse() * rotation(poses[0].value)).log().norm() < 1e-15);
  CHECK(convert_poses<Same>(Poses{}, "test").empty());
}

TEST_CASE("Rotations that have drifted a little are normalised, others refused") {
  Poses poses = two_poses();
  auto& drifted = poses[1].value.get<0>();
  for (int i = 0; i < 4; ++i) drifted.data()[i] *= 1.0009;
  const auto converted = convert_poses<Same>(poses, "test");
  CHECK(std::abs(rotation(converted[1].value).unit_quaternion().norm() - 1) < 1e-15);
  for (int i = 0; i < 4; ++i) drifted.data()[i] *= 1.0009;
  CHECK_THAT(message_of([&] { return convert_poses<Same>(poses, "test"); }),
             Catch::Matchers::Contains("test: pose 1 is off its group by 0.0018") &&
                 Catch::Matchers::Contains("expected at most 0.001"));
}

TEST_CASE("Times have to be finite and ascending, poses finite") {
  Poses poses = two_poses();
  const auto message = [&] { return message_of([&] { return convert_poses<Same>(poses, "test"); }); };
  poses[1].time = 1.0;
  CHECK(message() == "test: pose 1 is at time 1, expected a time after 1, that of the pose before it");
  poses[1].time = std::numeric_limits<double>::quiet_NaN();
  CHECK(message() == "test: pose 1 is at time nan, expected a finite number");
  poses = two_poses();
  poses[0].value.get<1>().y() = std::numeric_limits<double>::infinity();
  CHECK(message() == "test: pose 0 is not finite");
}
