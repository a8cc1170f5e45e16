// SPDX-License-Identifier: MIT
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/imu/describe.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <type_traits>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using testing::applied, testing::sample_with;

namespace {
const Eigen::Matrix3d G = (Eigen::Matrix3d() << 1, 2, 0, 0, 1, -1, 3, 0, 2).finished();
}

TEMPLATE_TEST_CASE("G times the true specific force is added to the reading, and not to the bias", "", float, double) {
  using Vector = Eigen::Vector3<TestType>;
  auto sample = sample_with<TestType>(Vector(1, 2, 3), Vector(4, 5, 6));
  sample.truth = {Vector(7, 7, 7), Vector(1, 2, 3)};
  sample = applied(GSensitivity{Eigen::Matrix3<TestType>(G.cast<TestType>())}, sample);
  CHECK(sample.value == Vector(6, 1, 12));
  CHECK(sample.bias == Vector(4, 5, 6));
}

TEMPLATE_TEST_CASE("Along a motion it is the specific force in the IMU's axes, whatever the accelerometer makes of it",
                   "", float, double) {
  using Scalar = TestType;
  const Ellipse<Scalar> motion;
  const Eigen::Matrix3<Scalar> sensitivity = (G * 1e-3).cast<Scalar>();
  const Imu imu{ErrorModel{GSensitivity{sensitivity}}, ErrorModel{ConstantBias{Scalar(100)}}};
  const Eigen::Vector3<Scalar> gravity(1, 2, -9);
  int n = 0;
  for (const auto& r : simulate(motion, imu, {.rate = 10, .gravity = gravity, .start = 0, .end = 20})) {
    const auto ideal = ideal_imu(motion.template evaluate<2>(r.time), gravity);
    CHECK(r.gyro == ideal.gyro + sensitivity * ideal.accel);
    CHECK(r.gyro_bias.isZero(0));
    ++n;
  }
  CHECK(n == 201);
}

TEST_CASE("A sensitivity is a finite matrix, zero too") {
  STATIC_CHECK(std::is_same_v<decltype(GSensitivity{Eigen::Matrix3f()}), GSensitivity<float>>);
  CHECK_NOTHROW(GSensitivity{Eigen::Matrix3d::Zero()});
  CHECK(GSensitivity{1e-3 * Eigen::Matrix3d::Identity()}.sensitivity(2, 2) == 1e-3);
  CHECK_THROWS_WITH(GSensitivity{Eigen::Matrix3d::Constant(testing::nan<double>)},
                    "GSensitivity: sensitivity is nan, expected a finite number");
}

TEST_CASE("A g-sensitivity in words") {
  CHECK(describe(GSensitivity{G}, SensorKind::gyro) ==
        "g-sensitivity: sensitivity (1 2 0; 0 1 -1; 3 0 2) rad/s/(m/s^2)");
}
