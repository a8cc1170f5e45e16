// SPDX-License-Identifier: MIT
// What holds a curve where poses do not: at the ends of high orders. Gaps are in fit_test.cpp.
#include <algorithm>
#include <cmath>
#include <random>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/coning.hpp>
#include <splinertia/spline/fit.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

using Pose3 = SO3xR3<double>;

const Coning<> motion{.angle = 0.3, .rate = 2};

/// Poses at 100 Hz, with noise of the same size in rad and m.
std::vector<Stamped<Pose3, double>> noisy_poses(double noise) {
  std::mt19937_64 bits(7);
  std::normal_distribution<double> normal(0, noise);
  std::vector<Stamped<Pose3, double>> poses;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i;
    Pose3 pose = motion.evaluate<0>(t).value;
    pose.get<0>() *= Sophus::SO3d::exp({normal(bits), normal(bits), normal(bits)});
    pose.get<1>() += Eigen::Vector3d(normal(bits), normal(bits), normal(bits));
    poses.push_back({t, pose});
  }
  return poses;
}

/// The largest error of the rotation, rad.
double rotation_error(const auto& curve) {
  double largest = 0;
  for (double t = 0; t <= 10; t += 0.013) {
    const auto truth = rotation(motion.evaluate<0>(t).value), found = rotation(curve.template evaluate<0>(t).value);
    largest = std::max(largest, increment(truth, found).norm());
  }
  return largest;
}

}  // namespace

TEST_CASE("The ends of a high order are held where noise would bend them beyond any rotation") {
  constexpr double noise = 2e-3;
  const auto poses = noisy_poses(noise);
  // Two poses for a knot.
  const auto uniform = fit<Spline<Pose3, 6>>(poses, {.knot_interval = 0.02});
  CHECK(uniform.converged);
  // Five standard deviations of a pose, of three components together.
  CHECK(rotation_error(uniform.spline) < 5 * std::sqrt(3.) * noise);

  // Knots that end together leave no control point outside; with fewer knots there are poses enough.
  const auto clamped = fit<Spline<Pose3, 6, NonUniformKnots<double>>>(poses, {.knot_interval = 0.02});
  CHECK(clamped.converged);
  CHECK(rotation_error(clamped.spline) < 5 * std::sqrt(3.) * noise);
  const auto coarser = fit<Spline<Pose3, 6>>(poses, {.knot_interval = 0.2});
  CHECK(coarser.converged);
}
