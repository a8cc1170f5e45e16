// SPDX-License-Identifier: MIT
#include <ceres/ceres.h>

#include <splinertia/adapters/ceres.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/spline/spline.hpp>

#include "adapters/ceres_checks.hpp"

using namespace splinertia;

// Everything at once, on SE3: control points in the memory of Sophus objects, both biases, the direction of gravity,
// and the offset of the clock that stamps the poses, from exact measurements and a bad start.
TEST_CASE("Ceres finds a curve on SE3, its IMU's biases, gravity and the clock's offset") {
  using G = Sophus::SE3d;
  using Curve = Spline<G, 5>;
  testing::Random random(1);
  const Curve truth({.start = 0.0, .interval = 0.2}, random.walk<G>(16, 0.3));
  const Eigen::Vector3d gyro_bias(0.1, -0.2, 0.3), accel_bias(0.3, 0.2, -0.5), gravity(0, 0, -9.81);
  const double offset = 0.037;

  std::vector<G> T = truth.control_points();
  for (G& x : T) x = GroupTraits<G>::compose(x, GroupTraits<G>::exp(random.tangent<G>(0.1)));
  Eigen::Vector3d gyro_guess(0, 0, 0), accel_guess(0, 0, 0), gravity_guess(2, -1, -9);
  gravity_guess *= 9.81 / gravity_guess.norm();
  double offset_guess = 0;

  ceres::Problem problem;
  auto* manifold = new CeresManifold<G>;
  for (G& x : T) problem.AddParameterBlock(x.data(), 7, manifold);
  problem.AddParameterBlock(gravity_guess.data(), 3, new ceres::SphereManifold<3>);
  const auto blocks = [&](std::size_t first, std::initializer_list<double*> others) {
    std::vector<double*> all;
    for (std::size_t j = first; j < first + 5; ++j) all.push_back(T[j].data());
    all.insert(all.end(), others);
    return all;
  };
  const auto n = T.size();
  for (int i = 0; i < 230; ++i) {
    const double t = 0.01 * i;
    const auto imu = ideal_imu(truth.at<2>(t), gravity);
    const auto [first, basis] = truth.knots().basis<double, 5, 1>(t, n);
    problem.AddResidualBlock(
        new CeresGyroscopeResidual<G, 5>(basis, imu.gyro + gyro_bias, 1e2 * Eigen::Matrix3d::Identity()), nullptr,
        blocks(first, {gyro_guess.data()}));
    problem.AddResidualBlock(
        new CeresAccelerometerResidual<G, 5>(truth.knots().basis<double, 5, 2>(t, n).basis, imu.accel + accel_bias,
                                             10 * Eigen::Matrix3d::Identity()),
        nullptr, blocks(first, {accel_guess.data(), gravity_guess.data()}));
    // A pose stamped t shows the curve at t + offset, of another segment at times: those are left out.
    const double u = t / 0.2 - static_cast<double>(first);
    if (i % 5 == 0 && u + offset / 0.2 < 1) {
      problem.AddResidualBlock(
          new CeresShiftedPoseResidual<G, 5>(u, 0.2, truth.at<0>(t + offset).value, 1e2 * Jacobian<G>::Identity()),
          nullptr, blocks(first, {&offset_guess}));
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-20;
  options.check_gradients = false;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  INFO(summary.BriefReport());
  CHECK(summary.IsSolutionUsable());
  CHECK(summary.iterations.size() < 25);
  CHECK(summary.final_cost < 1e-10);
  CHECK((gyro_guess - gyro_bias).norm() < 1e-6);
  CHECK((accel_guess - accel_bias).norm() < 1e-5);
  CHECK((gravity_guess - gravity).norm() < 1e-5);
  CHECK(std::abs(gravity_guess.norm() - 9.81) < 1e-12);
  CHECK(std::abs(offset_guess - offset) < 1e-7);
  for (std::size_t j = 0; j < n; ++j) {
    INFO("control point " << j);
    CHECK(increment(T[j], truth.control_points()[j]).norm() < 1e-4);
    CHECK(std::abs(T[j].unit_quaternion().norm() - 1) < 1e-14);
  }
}
