// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/mounting.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/spline/spline.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {
const Mounting mounting{Sophus::SO3d::exp({0.4, -0.8, 1.1}), Eigen::Vector3d(0.3, -0.5, 0.2)};
const Eigen::Vector3d gravity(0.1, 0.2, -9.8);

/// The rotation and position are equal to rounding.
void check_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double tolerance) {
  CHECK((a - b).norm() <= tolerance);
}
}  // namespace

TEST_CASE("By default an IMU is the body frame itself") {
  const Mounting<> none;
  CHECK(none.R_BI.unit_quaternion().w() == 1);
  CHECK(none.p_BI.isZero(0));
  const auto m = Ellipse<>{}.evaluate<2>(1.5);
  CHECK(ideal_imu(m, gravity, none).gyro == ideal_imu(m, gravity).gyro);
  CHECK(ideal_imu(m, gravity, none).accel == ideal_imu(m, gravity).accel);
}

TEMPLATE_TEST_CASE("The pose of the IMU is the body's times the mounting", "", SO3xR3<double>, Sophus::SE3d) {
  testing::Random random(3);
  const auto body = random.walk<TestType>(1)[0];
  const Sophus::SE3d T_WB(rotation(body), position(body)), T_BI(mounting.R_BI, mounting.p_BI);
  const TestType imu = imu_pose(body, mounting);
  CHECK((rotation(imu).matrix() - (T_WB * T_BI).so3().matrix()).norm() < 1e-15);
  check_near(position(imu), (T_WB * T_BI).translation(), 1e-14);
}

// The curve X(t) T with constant T has the control points X_i T, because log((X_i T)⁻¹ X_{i+1} T) = Ad(T⁻¹) log(X_i⁻¹
// X_{i+1}). The IMU is at the body frame of this curve, so nothing of the formulas for a mounting is used.
TEST_CASE("A mounted IMU reads what one in the body frame of the moved curve reads") {
  testing::Random random(1);
  const auto points = random.walk<Sophus::SE3d>(12);
  std::vector<Sophus::SE3d> moved;
  for (const auto& point : points) moved.push_back(point * Sophus::SE3d(mounting.R_BI, mounting.p_BI));
  const Spline<Sophus::SE3d, 5> curve({.start = 0, .interval = 0.5}, points),
      moved_curve({.start = 0, .interval = 0.5}, moved);
  const auto expected = simulate(moved_curve, Imu{}, {.rate = 100, .gravity = gravity});
  auto at = expected.begin();
  std::size_t samples = 0;
  for (const auto& r : simulate(curve, Imu{}, mounting, {.rate = 100, .gravity = gravity})) {
    CHECK(r.time == at->time);
    check_near(r.gyro, at->gyro, 1e-12);
    check_near(r.accel, at->accel, 4e-11);
    ++at;
    ++samples;
  }
  CHECK(at == expected.end());
  CHECK(samples == 401);
}

TEMPLATE_TEST_CASE("Simulated samples are those of ideal_imu, in SIMD packs and one by one", "",
                   (Spline<SO3xR3<double>, 4>), (Spline<Sophus::SE3d, 4>), Ellipse<>) {
  const auto motion = [] {
    if constexpr (std::is_same_v<TestType, Ellipse<>>) {
      return Ellipse<>{};
    } else {
      testing::Random random(2);
      return TestType({.start = 0, .interval = 0.5}, random.walk<typename TestType::Group>(12));
    }
  }();
  for (const auto& r : simulate(motion, Imu{}, mounting, {.rate = 90, .gravity = gravity, .start = 0.0, .end = 4.0})) {
    const auto expected = ideal_imu(motion.template evaluate<2>(r.time), gravity, mounting);
    check_near(r.gyro, expected.gyro, 1e-12);
    check_near(r.accel, expected.accel, 1e-11);
  }
}

TEST_CASE("Errors are in the axes of the IMU and do not depend on its mounting") {
  const Imu noisy{ErrorModel{WhiteNoise{0.01}, RandomWalk{1e-3}}, ErrorModel{WhiteNoise{0.1}}};
  const auto options = [](std::uint64_t imu) {
    return SimulationOptions<>{.rate = 50, .seed = 7, .imu = imu, .start = 0.0, .end = 2.0};
  };
  const Ellipse<> motion;
  const auto mounted = simulate(motion, noisy, mounting, options(0)),
             other = simulate(motion, noisy, mounting, options(1));
  auto same = mounted.begin(), second = other.begin();
  const auto clean = simulate(motion, Imu{}, mounting, options(0));
  auto ideal = clean.begin();
  for (const auto& r : simulate(motion, noisy, options(0))) {
    const auto body = ideal_imu(motion.evaluate<2>(r.time));
    check_near(same->gyro - ideal->gyro, r.gyro - body.gyro, 1e-13);
    check_near(same->accel - ideal->accel, r.accel - body.accel, 1e-13);
    CHECK(same->gyro_bias == r.gyro_bias);
    CHECK(second->gyro != same->gyro);  // another IMU of the run: other errors on the same motion
    ++same, ++second, ++ideal;
  }
}

TEST_CASE("An IMU that is not mounted takes no room for it, and a mounting has to be finite") {
  using Motion = Ellipse<>;
  STATIC_CHECK(sizeof(Simulation<Motion, Imu<>, Xoshiro256>) + sizeof(Mounting<>) <=
               sizeof(Simulation<Motion, Imu<>, Xoshiro256, Mounting<>>) + 8);
  Mounting bad = mounting;
  bad.p_BI.y() = std::numeric_limits<double>::infinity();
  CHECK(testing::message_of([&] { return simulate(Ellipse<>{}, Imu{}, bad, {.start = 0.0, .end = 1.0}).size(); }) ==
        "simulate: the lever arm p_BI[1] is inf, expected a finite number");
}
