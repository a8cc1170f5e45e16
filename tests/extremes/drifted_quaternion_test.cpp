// SPDX-License-Identifier: MIT
/// Control points whose quaternions have drifted from unit length by 1e-6, as many products leave them.
///
/// What is made of increments alone takes no harm, because the logarithm does not see the length: rotation, angular
/// velocity, angular acceleration, and all of R³. The value keeps the length of its first control point. What is turned
/// by a quaternion of length 1 + e, as if it were of unit length, is off by up to 4e of its size: v + 2u × (wv + u × v)
/// is (1 − (1 + e)²) v + (1 + e)² R v.
#include <splinertia/motion/kinematics.hpp>

#include "extremes.hpp"

using namespace splinertia;
using namespace extremes;

namespace {

constexpr double drift = 1e-6;

template <typename G>
std::vector<G> drifted(std::vector<G> points) {
  using Scalar = ScalarOf<G>;
  testing::Random random(31);
  for (G& x : points) {
    const auto length = static_cast<Scalar>(1 + drift * (random.symmetric() > 0 ? 1 : -1));
    if constexpr (Pose<G>) {
      const Eigen::Quaternion<Scalar> q(rotation(x).unit_quaternion().coeffs() * length);
      x = make_pose<G>(rotation_from_unit_quaternion<Scalar>(q), position(x));
    } else {
      x = rotation_from_unit_quaternion<Scalar>(Eigen::Quaternion<Scalar>(x.unit_quaternion().coeffs() * length));
    }
  }
  return points;
}

}  // namespace

TEMPLATE_TEST_CASE("Drift does no harm to rotations, nor to positions beside them", "", Sophus::SO3f, Sophus::SO3d,
                   SO3xR3<double>) {
  using G = TestType;
  testing::Random random(32);
  const auto points = drifted(random.walk<G>(6, 1));
  Worst worst;
  for_orders([&]<int Order>() { compare_segments<Order>(worst, 1, points); });
  worst.require(std::string("drifted by 1e-6, ") + Layout<G>::name + " " + scalar_name<ScalarOf<G>>);
}

TEST_CASE("Small increments between drifted control points lose what the drift is larger by") {
  // The difference of two quaternions is taken (rotation_increment): of their lengths, 1e-6, instead of the rotation.
  testing::Random random(33);
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Sophus::SO3d x = random.walk<Sophus::SO3d>(1)[0];
    const Sophus::SO3d y = GroupTraits<Sophus::SO3d>::compose(x, Sophus::SO3d::exp({angle, 0, 0}));
    const auto points = drifted(std::vector{x, y});
    const Eigen::Vector3d d = increment(points[0], points[1]);
    const LongVector<3> gold =
        increment(Layout<Sophus::SO3d>::widen(points[0]), Layout<Sophus::SO3d>::widen(points[1]));
    CHECK((d.cast<Long>() - gold).norm() < limit * eps<double> * (gold.norm() + 2 * drift));
  }
}

TEST_CASE("What drifted quaternions turn is off by four times the drift, of its size") {
  using G = Sophus::SE3d;
  testing::Random random(34);
  const auto points = random.walk<G>(12, 1);
  const Spline<G, 4> unit_curve({.start = 0, .interval = 1}, points),
      curve({.start = 0, .interval = 1}, drifted(points));
  double turn = 0, place = 0, velocity = 0, force = 0;
  for (int i = 0; i <= 90; ++i) {
    const auto m = curve.evaluate<2>(0.1 * i), n = unit_curve.evaluate<2>(0.1 * i);
    turn = std::max(turn, increment<Sophus::SO3d>(rotation(m.value), rotation(n.value)).norm());
    place = std::max(place, (position(m.value) - position(n.value)).norm());
    velocity = std::max(velocity, (m.velocity - n.velocity).norm() / n.velocity.norm());
    const Eigen::Vector3d gravity(0, 0, -9.80665);
    force = std::max(force, (specific_force(m, gravity) - specific_force(n, gravity)).norm());
  }
  std::printf(
      "drifted by 1e-6, SE3 double: rotation %.1e rad, position %.1e m of 1 m steps, velocity %.1e of its size, "
      "specific force %.1e m/s^2\n",
      turn, place, velocity, force);
  CHECK(turn < 64 * eps<double>);    // the logarithms of 12 points and of two values
  CHECK(place < 4 * drift * 3 * 2);  // increments and value: each of three steps, up to √3 m, is turned there and back
  CHECK(velocity < 4 * drift * 2);
  CHECK(force < 4 * drift * (9.80665 + 10));  // accelerations here are below 10 m/s²
}
