// SPDX-License-Identifier: MIT
#include <splinertia/group/pose.hpp>

#include "group/sophus_laws.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEMPLATE_TEST_CASE("SO(3) × R³ is a Lie group", "[group]", float, double, long double) {
  laws::hold_for<SO3xR3<TestType>>();
}

TEMPLATE_TEST_CASE("a pose of either kind is made and read alike", "[group]", SO3xR3<float>, SO3xR3<double>,
                   SO3xR3<long double>, Sophus::SE3f, Sophus::SE3d, Sophus::SE3<long double>) {
  using Scalar = ScalarOf<TestType>;
  STATIC_CHECK(Pose<TestType>);
  STATIC_CHECK(SplitPose<TestType> != RigidPose<TestType>);
  const auto R_WB = GroupTraits<Sophus::SO3<Scalar>>::exp({Scalar(1), Scalar(-2), Scalar(0.5)});
  const Eigen::Vector3<Scalar> p_WB{Scalar(1), Scalar(2), Scalar(3)};
  const auto pose = make_pose<TestType>(R_WB, p_WB);
  CHECK(rotation(pose).unit_quaternion().coeffs() == R_WB.unit_quaternion().coeffs());  // to the bit
  CHECK(position(pose) == p_WB);
}

TEST_CASE("what is not a pose", "[group]") {
  STATIC_CHECK_FALSE(Pose<Sophus::SO3d>);
  STATIC_CHECK_FALSE(Pose<Sophus::SE2d>);
  STATIC_CHECK_FALSE(Pose<Product<Eigen::Vector3d, Sophus::SO3d>>);  // the factors the other way round
  STATIC_CHECK_FALSE(Pose<int>);
}
