// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <splinertia/imu/describe.hpp>
#include <splinertia/imu/errors/size_effect.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <vector>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;

namespace {

const Eigen::Matrix3d positions{{0.01, 0.02, -0.01}, {0.03, -0.02, 0.01}, {0, 0.01, 0.02}};

// The largest error of the accelerometer after `skipped` samples, beside IMUs at the three positions.
double worst_error(double rate, int skipped) {
  const Ellipse<> motion;
  const Imu imu{ErrorModel{}, ErrorModel{SizeEffect{positions}}};
  double worst = 0;
  int n = 0;
  for (const auto& r : simulate(motion, imu, {.rate = rate, .start = 0.0, .end = 5.0})) {
    if (n++ < skipped) continue;
    for (int i = 0; i < 3; ++i) {
      const Mounting<double> mounting{Sophus::SO3d(), positions.col(i)};
      const auto ideal = ideal_imu(motion.evaluate<2>(r.time), standard_gravity<double>(), mounting);
      worst = std::max(worst, std::abs(r.accel[i] - ideal.accel[i]));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("Each accelerometer reads as an IMU at its place, with an error of second order in the interval") {
  const double coarse = worst_error(100, 2), fine = worst_error(200, 2);
  CHECK(fine < 1e-5);
  CHECK(coarse / fine > 3.6);
  CHECK(coarse / fine < 4.4);
}

TEST_CASE("The difference formula is exact for a parabola at irregular intervals") {
  const auto rate = [](double t) { return Eigen::Vector3d(1 + 2 * t - t * t, 3 * t * t, 0.5 - t); };
  const auto slope = [](double t) { return Eigen::Vector3d(2 - 2 * t, 6 * t, -1); };
  const SizeEffect term{positions};
  StateOf<SizeEffect<double>> state;
  double last = 0;
  for (const double t : {0.0, 0.5, 0.75, 1.75, 1.875}) {
    ImuSensorSample<double> sample{{{0, 0, 0}, {1, 1, 1}, t == 0 ? 1 : t - last, t == 0, t}, {rate(t), {0, 0, 0}}};
    term.apply(sample, state);
    CHECK(sample.bias == Eigen::Vector3d(1, 1, 1));
    last = t;
    const Eigen::Vector3d alpha = t == 0 ? Eigen::Vector3d::Zero() : slope(t);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d r = positions.col(i), omega = rate(t);
      const Eigen::Vector3d expected = alpha.cross(r) + omega.cross(omega.cross(r));
      if (t != 0.5) CHECK(std::abs(sample.value[i] - expected[i]) < 1e-14);
    }
  }
}

TEST_CASE("Positions are described and checked") {
  CHECK(describe(SizeEffect{positions}, SensorKind::accel) ==
        "size effect: positions (0.01 0.02 -0.01; 0.03 -0.02 0.01; 0 0.01 0.02) m");
  CHECK_THROWS_AS(SizeEffect{Eigen::Matrix3d::Constant(1e200)}, std::invalid_argument);
  CHECK_THROWS_AS(SizeEffect{Eigen::Matrix3d::Constant(testing::nan<double>)}, std::invalid_argument);
}
