// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/group/detail/turn_angle.hpp>
#include <splinertia/group/pose.hpp>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// The angle of exp(δ) as its rotation has it, for turns below π.
template <typename G>
double angle_of_exp(const Tangent<G>& delta) {
  const G x = GroupTraits<G>::exp(delta);
  if constexpr (requires { x.so3(); }) {
    return x.so3().log().norm();
  } else if constexpr (requires { x.so2(); }) {
    return std::abs(x.so2().log());
  } else if constexpr (requires { x.unit_complex(); }) {
    return std::abs(x.log());
  } else {
    return x.log().norm();
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Of a group with rotations, the angle of exp", "[group]", Sophus::SO2d, Sophus::SO3d, Sophus::SE2d,
                   Sophus::SE3d, Sophus::SO3f, Sophus::SE3f) {
  using G = TestType;
  testing::Random random(1);
  for (const double size : {0., 1e-9, 1e-3, 1., 1.8}) {  // 1.8 √3 is less than π
    const Tangent<G> delta = random.tangent<G>(size);
    const double tolerance = 16 * std::numeric_limits<ScalarOf<G>>::epsilon();
    CHECK_THAT(double{TurnAngle<G>::of(delta)}, WithinAbs(angle_of_exp<G>(delta), tolerance * (1 + size)));
  }
}

TEST_CASE("Translations turn nothing") {
  CHECK(TurnAngle<Eigen::Vector3d>::of({1, 2, 3}) == 0);
  Tangent<Sophus::SE3d> rigid;
  rigid << 100, 200, 300, 0, 0, 0.5;
  CHECK(TurnAngle<Sophus::SE3d>::of(rigid) == 0.5);
  CHECK(TurnAngle<Sophus::SE2d>::of({100, 200, -0.5}) == 0.5);
}

TEST_CASE("Beyond half a turn it goes on") {
  CHECK(TurnAngle<Sophus::SO3d>::of({0, 4, 0}) == 4);
  CHECK(TurnAngle<Sophus::SE2d>::of({0, 0, -7}) == 7);
}

TEST_CASE("Of a product, the largest of its factors") {
  using Split = SO3xR3<double>;
  Tangent<Split> delta;
  delta << 0, 0.3, -0.4, 10, 20, 30;
  CHECK(TurnAngle<Split>::of(delta) == 0.5);
  using Two = Product<Eigen::Vector2d, Sophus::SO3d, Sophus::SO2d>;
  Tangent<Two> two;
  two << 9, 9, 0, 0.1, 0, -0.2;
  CHECK(TurnAngle<Two>::of(two) == 0.2);
  two[3] = 0.7;
  CHECK(TurnAngle<Two>::of(two) == 0.7);
  using Nested = Product<Eigen::Vector3d, Two>;
  Tangent<Nested> nested;
  nested << 5, 5, 5, two;
  CHECK(TurnAngle<Nested>::of(nested) == 0.7);
  using Positions = Product<Eigen::Vector3d, Eigen::Vector2d>;
  CHECK(TurnAngle<Positions>::of(Tangent<Positions>::Ones()) == 0);
}
