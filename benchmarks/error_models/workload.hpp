// SPDX-License-Identifier: MIT
/// What the loops of the benchmark program error_models work on.
#pragma once

#include <cstddef>
#include <random>
#include <splinertia/splinertia.hpp>
#include <vector>

using namespace splinertia;
using Vector = Eigen::Vector3d;

namespace {

constexpr std::size_t longest_run = 20000;  // samples; more calls are several runs

/// 200 Hz, unknown while compiling.
double rate() {
  static volatile double value = 200;
  return value;
}

struct Sums {
  Vector gyro = Vector::Zero(), accel = Vector::Zero();
};

struct Workload {
  std::vector<Vector> measurements;
  std::vector<SO3xR3<double>> control_points;

  Workload() {
    std::mt19937_64 bits(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angle(-0.29, 0.29);
    for (int i = 0; i < 4096; ++i) measurements.emplace_back(normal(bits), normal(bits), normal(bits));
    Sophus::SO3d R;
    for (int i = 0; i < 1010; ++i) {
      R = GroupTraits<Sophus::SO3d>::compose(R,
                                             GroupTraits<Sophus::SO3d>::exp({angle(bits), angle(bits), angle(bits)}));
      control_points.push_back(make_pose<SO3xR3<double>>(R, Vector(normal(bits), normal(bits), normal(bits))));
    }
  }
};

const Workload& workload() {
  static const Workload the;
  return the;
}

using Curve = Spline<SO3xR3<double>, 4>;

const Curve& curve() {
  static const Curve the({.start = 0.0, .interval = 0.1}, workload().control_points);
  return the;
}

const StreamKey run_key = StreamKey(0) / 0;  // of simulate() with seed 0

}  // namespace
