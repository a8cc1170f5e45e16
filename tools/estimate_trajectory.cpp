// SPDX-License-Identifier: MIT
// Estimates a curve from noisy poses and an IMU with Ceres: control points, biases and the direction of gravity
// together. Compares the result with the truth from which the measurements were simulated.

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/sphere_manifold.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <splinertia/adapters/ceres.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/splinertia.hpp>
#include <vector>

#include "support/common_options.hpp"
#include "support/concat.hpp"
#include "support/csv_table.hpp"
#include "support/program.hpp"

using namespace splinertia;

namespace {

constexpr int order = 4;
using Group = SO3xR3<double>;
using Curve = Spline<Group, order>;

struct Options {
  double duration = 10;
  double knot_interval = 0.1;
  double imu_rate = 200;
  double pose_rate = 10;
  double position_noise = 0.02, attitude_noise = 0.01;  // standard deviations, m and rad
  double gyro_noise = 1e-3, accel_noise = 1e-2;         // densities
  double gravity_tilt = 5;                              // deg
  std::uint64_t seed = 0;
  int iterations = 50;
  std::filesystem::path csv;
};

/// Motion, biases and gravity: the true values, or an estimate of them.
struct Estimate {
  UniformKnots<double> knots;
  std::vector<Sophus::SO3d> rotations;
  std::vector<Eigen::Vector3d> positions;
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();   // rad/s
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  // m/s²
  Eigen::Vector3d gravity = standard_gravity<double>();  // m/s²

  Curve curve() const {
    std::vector<Group> control_points;
    for (std::size_t i = 0; i < rotations.size(); ++i) control_points.emplace_back(rotations[i], positions[i]);
    return {knots, control_points};
  }
};

struct Measurements {
  std::vector<Stamped<Group, double>> poses;
  std::vector<ImuReading> imu;
};

/// An agile flight around the origin. Control point i belongs to the time of i − 1 knot intervals.
Estimate true_motion(const Options& o) {
  Estimate e{.knots = {.start = 0, .interval = o.knot_interval}, .rotations = {}, .positions = {}};
  const auto segments = static_cast<int>(std::ceil(o.duration / o.knot_interval - 1e-9));
  for (int i = 0; i < segments + order - 1; ++i) {
    const double t = (i - 1) * o.knot_interval;
    const Eigen::Vector3d phi(0.4 * std::sin(1.7 * t), 0.5 * std::sin(1.3 * t + 1), std::sin(0.9 * t));
    e.rotations.push_back(GroupTraits<Sophus::SO3d>::exp(phi));
    e.positions.emplace_back(3 * std::sin(1.1 * t), 2 * std::cos(1.4 * t), std::sin(0.8 * t));
  }
  e.gyro_bias = {0.02, -0.03, 0.01};
  e.accel_bias = {0.1, 0.2, -0.15};
  return e;
}

Measurements measure(const Estimate& truth, const Options& o) {
  const Curve curve = truth.curve();
  Measurements m;
  const Imu imu{ErrorModel{ConstantBias{truth.gyro_bias}, WhiteNoise{o.gyro_noise}},
                ErrorModel{ConstantBias{truth.accel_bias}, WhiteNoise{o.accel_noise}}};
  for (const ImuReading& r : simulate(curve, imu, {.rate = o.imu_rate, .seed = o.seed, .gravity = truth.gravity})) {
    m.imu.push_back(r);
  }
  NormalStreams attitude(StreamKey(o.seed) / "attitude"), position(StreamKey(o.seed) / "position");
  const auto count = static_cast<int>((curve.end() - curve.start()) * o.pose_rate * (1 + 1e-12)) + 1;
  for (int i = 0; i < count; ++i) {
    const double t = std::min(curve.start() + i / o.pose_rate, curve.end());
    Tangent<Group> noise;
    noise << o.attitude_noise * attitude.draw<double>(), o.position_noise * position.draw<double>();
    const Group pose = curve.evaluate<0>(t).value;
    m.poses.push_back({t, GroupTraits<Group>::compose(pose, GroupTraits<Group>::exp(noise))});
  }
  return m;
}

/// The initial estimate: control points interpolated from the measured poses, zero biases, tilted gravity.
Estimate first_guess(const Measurements& m, const Estimate& truth, const Options& o) {
  Estimate e{.knots = truth.knots, .rotations = {}, .positions = {}};
  std::size_t i = 0;
  for (std::size_t j = 0; j < truth.rotations.size(); ++j) {
    const double t = (static_cast<double>(j) - 1) * o.knot_interval;
    while (i + 2 < m.poses.size() && m.poses[i + 1].time <= t) ++i;
    const auto& [t0, x0] = m.poses[i];
    const auto& [t1, x1] = m.poses[i + 1];
    const Tangent<Group> step = increment(x0, x1) * ((t - t0) / (t1 - t0));
    const Group x = GroupTraits<Group>::compose(x0, GroupTraits<Group>::exp(step));
    e.rotations.push_back(rotation(x));
    e.positions.push_back(position(x));
  }
  const double tilt = o.gravity_tilt * 3.14159265358979323846 / 180;
  e.gravity = GroupTraits<Sophus::SO3d>::exp({0.6 * tilt, 0.8 * tilt, 0}) * truth.gravity;
  return e;
}

/// Optimises all unknowns in `e` in place, by nonlinear least squares.
ceres::Solver::Summary estimate(Estimate& e, const Measurements& m, const Options& o) {
  ceres::Problem problem;
  auto* rotations = new CeresManifold<Sophus::SO3d>;  // the problem owns it
  for (auto& R : e.rotations) problem.AddParameterBlock(R.data(), 4, rotations);
  problem.AddParameterBlock(e.gravity.data(), 3, new ceres::SphereManifold<3>);

  const std::size_t n = e.rotations.size();
  const auto rotation_blocks = [&](std::size_t first) {
    std::vector<double*> blocks;
    for (std::size_t j = first; j < first + order; ++j) blocks.push_back(e.rotations[j].data());
    return blocks;
  };
  const auto pose_blocks = [&](std::size_t first) {
    std::vector<double*> blocks = rotation_blocks(first);
    for (std::size_t j = first; j < first + order; ++j) blocks.push_back(e.positions[j].data());
    return blocks;
  };

  Jacobian<Group> pose_weight = Jacobian<Group>::Identity();
  pose_weight.diagonal() << Eigen::Vector3d::Constant(1 / o.attitude_noise),
      Eigen::Vector3d::Constant(1 / o.position_noise);
  for (const auto& [t, pose] : m.poses) {
    const auto [first, basis] = e.knots.basis<double, order, 0>(t, n);
    problem.AddResidualBlock(new CeresPoseResidual<Group, order>(basis, pose, pose_weight), nullptr,
                             pose_blocks(first));
  }
  // White noise of density N has standard deviation N √rate in a sample.
  const Eigen::Matrix3d gyro_weight = Eigen::Matrix3d::Identity() / (o.gyro_noise * std::sqrt(o.imu_rate));
  const Eigen::Matrix3d accel_weight = Eigen::Matrix3d::Identity() / (o.accel_noise * std::sqrt(o.imu_rate));
  for (const ImuReading& r : m.imu) {
    const auto [first, basis] = e.knots.basis<double, order, 1>(r.time, n);
    auto gyro_blocks = rotation_blocks(first);
    gyro_blocks.push_back(e.gyro_bias.data());
    problem.AddResidualBlock(new CeresGyroscopeResidual<Sophus::SO3d, order>(basis, r.gyro, gyro_weight), nullptr,
                             gyro_blocks);
    auto accel_blocks = pose_blocks(first);
    accel_blocks.insert(accel_blocks.end(), {e.accel_bias.data(), e.gravity.data()});
    problem.AddResidualBlock(new CeresAccelerometerResidual<Group, order>(
                                 e.knots.basis<double, order, 2>(r.time, n).basis, r.accel, accel_weight),
                             nullptr, accel_blocks);
  }

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

void add_options(CLI::App& app, Options& o) {
  app.add_option("--duration", o.duration, "duration of the motion [s]")->capture_default_str();
  app.add_option("--knot-interval", o.knot_interval, "knot interval of the curve [s]")->capture_default_str();
  app.add_option("--imu-rate", o.imu_rate, "sampling rate of the IMU [Hz]")->capture_default_str();
  app.add_option("--pose-rate", o.pose_rate, "rate of the poses [Hz]")->capture_default_str();
  app.add_option("--position-noise", o.position_noise, "standard deviation of a position [m]")->capture_default_str();
  app.add_option("--attitude-noise", o.attitude_noise, "standard deviation of an attitude [rad]")
      ->capture_default_str();
  app.add_option("--gyro-noise", o.gyro_noise, "white noise density [rad/s/sqrt(Hz)]")->capture_default_str();
  app.add_option("--accel-noise", o.accel_noise, "white noise density [m/s^2/sqrt(Hz)]")->capture_default_str();
  app.add_option("--gravity-tilt", o.gravity_tilt, "error of the first guess of gravity [deg]")->capture_default_str();
  app.add_option("--iterations", o.iterations, "largest number of iterations")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_seed_option(app, o.seed, "seed of the noise; gives the same measurements on every machine");
  add_csv_option(app, o.csv, "also write the table of errors to this file");
}

/// Throws std::invalid_argument for an option that is out of range. Most are divisors and must be positive.
void check(const Options& o) {
  const auto require = [](const char* name, double value, double most) {
    if (!(value > 0 && value <= most)) {
      throw std::invalid_argument(concat(name, ": ", value, ", expected a positive number up to ", most));
    }
  };
  require("--duration", o.duration, 1e4);
  require("--knot-interval", o.knot_interval, o.duration);
  require("--imu-rate", o.imu_rate, 1e5);
  require("--pose-rate", o.pose_rate, 1e5);
  require("--position-noise", o.position_noise, 1e3);
  require("--attitude-noise", o.attitude_noise, 3);
  require("--gyro-noise", o.gyro_noise, 1e3);
  require("--accel-noise", o.accel_noise, 1e3);
  if (!(std::abs(o.gravity_tilt) <= 180)) {
    throw std::invalid_argument(concat("--gravity-tilt: ", o.gravity_tilt, ", expected -180 to 180 degrees"));
  }
  if (!(o.duration * o.pose_rate >= 1)) {
    throw std::invalid_argument(
        concat("--pose-rate: ", o.pose_rate, " Hz gives fewer than 2 poses in ", o.duration, " s"));
  }
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
