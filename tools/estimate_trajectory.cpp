// SPDX-License-Identifier: MIT
// Estimates a curve from noisy poses and an IMU with Ceres: control points, biases and the direction of gravity
// together. Compares the result with the truth from which the measurements were simulated.

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/sphere_manifold.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <splinertia/adapters/ceres.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/splinertia.hpp>
#include <stdexcept>
#include <vector>

#include "estimate_trajectory/options.hpp"
#include "estimate_trajectory/simulation.hpp"
#include "support/csv_table.hpp"
#include "support/program.hpp"

using namespace splinertia;

namespace {

/// The parameter blocks of Ceres for the control points of the segment that begins with number `first`: their
/// rotations; pose_blocks() adds their positions.
std::vector<double*> rotation_blocks(Estimate& e, std::size_t first) {
  std::vector<double*> blocks;
  for (std::size_t j = first; j < first + order; ++j) blocks.push_back(e.rotations[j].data());
  return blocks;
}
std::vector<double*> pose_blocks(Estimate& e, std::size_t first) {
  std::vector<double*> blocks = rotation_blocks(e, first);
  for (std::size_t j = first; j < first + order; ++j) blocks.push_back(e.positions[j].data());
  return blocks;
}

void add_poses(ceres::Problem& problem, Estimate& e, const Measurements& m, const Options& o) {
  Jacobian<Group> weight = Jacobian<Group>::Identity();
  weight.diagonal() << Eigen::Vector3d::Constant(1 / o.attitude_noise), Eigen::Vector3d::Constant(1 / o.position_noise);
  for (const auto& [t, pose] : m.poses) {
    const auto [first, basis] = e.knots.basis<double, order, 0>(t, e.rotations.size());
    problem.AddResidualBlock(new CeresPoseResidual<Group, order>(basis, pose, weight), nullptr, pose_blocks(e, first));
  }
}

void add_samples(ceres::Problem& problem, Estimate& e, const Measurements& m, const Options& o) {
  const std::size_t n = e.rotations.size();
  // White noise of density N has standard deviation N √rate in a sample.
  const Eigen::Matrix3d gyro_weight = Eigen::Matrix3d::Identity() / (o.gyro_noise * std::sqrt(o.imu_rate));
  const Eigen::Matrix3d accel_weight = Eigen::Matrix3d::Identity() / (o.accel_noise * std::sqrt(o.imu_rate));
  for (const ImuReading& r : m.imu) {
    const auto [first, basis] = e.knots.basis<double, order, 1>(r.time, n);
    auto gyro_blocks = rotation_blocks(e, first);
    gyro_blocks.push_back(e.gyro_bias.data());
    problem.AddResidualBlock(new CeresGyroscopeResidual<Sophus::SO3d, order>(basis, r.gyro, gyro_weight), nullptr,
                             gyro_blocks);
    auto accel_blocks = pose_blocks(e, first);
    accel_blocks.insert(accel_blocks.end(), {e.accel_bias.data(), e.gravity.data()});
    problem.AddResidualBlock(new CeresAccelerometerResidual<Group, order>(
                                 e.knots.basis<double, order, 2>(r.time, n).basis, r.accel, accel_weight),
                             nullptr, accel_blocks);
  }
}

/// Optimises all unknowns in `e` in place, by nonlinear least squares.
ceres::Solver::Summary estimate(Estimate& e, const Measurements& m, const Options& o) {
  ceres::Problem problem;
  auto* rotations = new CeresManifold<Sophus::SO3d>;  // the problem owns it
  for (auto& R : e.rotations) problem.AddParameterBlock(R.data(), 4, rotations);
  problem.AddParameterBlock(e.gravity.data(), 3, new ceres::SphereManifold<3>);
  add_poses(problem, e, m, o);
  add_samples(problem, e, m, o);

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = o.iterations;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

struct Errors {
  double position = 0, attitude = 0, velocity = 0;    // rms over the curve: m, deg, m/s
  double gyro_bias = 0, accel_bias = 0, gravity = 0;  // rad/s, m/s², deg
};

Errors compare(const Estimate& e, const Estimate& truth) {
  constexpr double degree = 3.14159265358979323846 / 180;
  const Curve curve = e.curve(), true_curve = truth.curve();
  Errors errors;
  constexpr int samples = 1000;
  for (int i = 0; i <= samples; ++i) {
    const double t = curve.start() + (curve.end() - curve.start()) * i / samples;
    const auto m = curve.at<1>(std::min(t, curve.end())), expected = true_curve.at<1>(std::min(t, curve.end()));
    errors.position += (position(m.value) - position(expected.value)).squaredNorm();
    errors.attitude += increment(rotation(m.value), rotation(expected.value)).squaredNorm();
    errors.velocity += (world_velocity(m) - world_velocity(expected)).squaredNorm();
  }
  errors.position = std::sqrt(errors.position / (samples + 1));
  errors.attitude = std::sqrt(errors.attitude / (samples + 1)) / degree;
  errors.velocity = std::sqrt(errors.velocity / (samples + 1));
  errors.gyro_bias = (e.gyro_bias - truth.gyro_bias).norm();
  errors.accel_bias = (e.accel_bias - truth.accel_bias).norm();
  errors.gravity = std::atan2(e.gravity.cross(truth.gravity).norm(), e.gravity.dot(truth.gravity)) / degree;
  return errors;
}

struct Row {
  const char* quantity;
  const char* unit;
  double Errors::*error;
};
constexpr Row rows[] = {{"position rms", "m", &Errors::position},     {"attitude rms", "deg", &Errors::attitude},
                        {"velocity rms", "m/s", &Errors::velocity},   {"gyro bias", "rad/s", &Errors::gyro_bias},
                        {"accel bias", "m/s^2", &Errors::accel_bias}, {"gravity direction", "deg", &Errors::gravity}};

void run(const Options& o) {
  const Estimate truth = true_motion(o);
  const Measurements m = measure(truth, o);
  Estimate e = first_guess(m, truth, o);
  std::printf("%zu poses at %g Hz, %zu IMU samples at %g Hz, %zu control points %g s apart, seed %llu\n",
              m.poses.size(), o.pose_rate, m.imu.size(), o.imu_rate, e.rotations.size(), o.knot_interval,
              static_cast<unsigned long long>(o.seed));
  const Errors before = compare(e, truth);
  const ceres::Solver::Summary summary = estimate(e, m, o);
  const Errors after = compare(e, truth);
  const int degrees_of_freedom = summary.num_residuals_reduced - summary.num_effective_parameters_reduced;
  std::printf("Ceres: %s after %zu iterations, cost %.4g to %.4g, %.3f per degree of freedom\n\n",
              ceres::TerminationTypeToString(summary.termination_type), summary.iterations.size() - 1,
              summary.initial_cost, summary.final_cost, 2 * summary.final_cost / degrees_of_freedom);
  std::puts("error                      initial      final");
  for (const Row& row : rows) {
    std::printf("%-17s %-6s %9.3g  %9.3g\n", row.quantity, row.unit, before.*row.error, after.*row.error);
  }
  if (!o.csv.empty()) {
    AtomicFile file(o.csv);
    CsvTable table(file, {"quantity", "unit", "initial", "final"});
    for (const Row& row : rows) table.row(row.quantity, row.unit, before.*row.error, after.*row.error);
    file.commit();
  }
  if (summary.termination_type != ceres::CONVERGENCE) throw std::runtime_error("no convergence: " + summary.message);
}

}  // namespace

const Program this_program{
    "estimate_trajectory",
    "Simulates noisy poses and an IMU with biases along a motion, and estimates from them, with Ceres, the control\n"
    "points of a B-spline on SO(3) x R^3, the biases and the direction of gravity. Prints their errors before and\n"
    "after.",
    [](CLI::App& app) -> std::function<void()> {
      static Options options;
      add_options(app, options);
      return [] {
        check(options);
        run(options);
      };
    }};
