// SPDX-License-Identifier: MIT
/// What both sides of each pair work on.
#pragma once

#include <concepts>
#include <random>

#include "curve_pairs.hpp"
#include "integration_pairs.hpp"

namespace {

using namespace splinertia::detail;

// Both sides of each pair get the same: 100 control points 0.1 s apart, increments of rotation up to 0.5 rad, positions
// ~ N(0, 1) m, calls at random times; 1000 readings at 200 Hz of a body that turns with up to 3 rad/s.

struct Workload {
  std::vector<SO3> rotations;
  std::vector<Vector> positions;
  std::vector<double> times;
  std::vector<Reading> readings;

  Workload() {
    std::mt19937_64 bits(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angle(-0.29, 0.29), time(0, 9.7);
    SO3 R;
    for (int i = 0; i < 100; ++i) {
      R = GroupTraits<SO3>::compose(R, GroupTraits<SO3>::exp({angle(bits), angle(bits), angle(bits)}));
      rotations.push_back(R);
      positions.emplace_back(normal(bits), normal(bits), normal(bits));
    }
    for (int i = 0; i < 4096; ++i) times.push_back(time(bits));
    for (int i = 0; i < 1000; ++i) {
      const double t = i / 200.0;
      readings.push_back({t, Vector(3 * std::sin(t), 2 * std::cos(2 * t), std::sin(3 * t)),
                          Vector(std::cos(t), 2 * std::sin(2 * t), 9.8 + std::sin(t))});
    }
  }
};

const Workload& workload() {
  static const Workload the;
  return the;
}

template <typename G>
const Cubic<G>& curve() {
  static const Cubic<G> the = [] {
    std::vector<G> points;
    const auto& [rotations, positions, times, readings] = workload();
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      if constexpr (std::same_as<G, SO3>) {
        points.push_back(rotations[i]);
      } else if constexpr (std::same_as<G, Vector>) {
        points.push_back(positions[i]);
      } else if constexpr (std::same_as<G, Sophus::SE2d>) {
        points.emplace_back(0.3 * static_cast<double>(i), positions[i].template head<2>());
      } else {
        points.push_back(make_pose<G>(rotations[i], positions[i]));
      }
    }
    return Cubic<G>({.start = 0, .interval = 0.1}, points);
  }();
  return the;
}

constexpr PlainKnots plain_knots{0, 0.1};

PlainRotations plain_rotations() {
  PlainRotations plain{plain_knots, {}, curve<SO3>().increments()};
  for (const SO3& R : curve<SO3>().control_points()) plain.q.push_back(R.unit_quaternion());
  return plain;
}

PlainPlanar plain_planar() {
  PlainPlanar plain{plain_knots, {}, {}, {}, {}, {}};
  for (const auto& x : curve<Sophus::SE2d>().control_points()) {
    plain.cosine.push_back(x.so2().unit_complex().x());
    plain.sine.push_back(x.so2().unit_complex().y());
    plain.p.push_back(x.translation());
  }
  for (const auto& d : curve<Sophus::SE2d>().increments()) {
    plain.angle.push_back(d[2]);
    plain.rho.push_back(d.head<2>());
  }
  return plain;
}

template <typename G>
PlainPoses plain_poses() {
  PlainPoses plain{plain_knots, {}, {}, {}, {}};
  for (const G& x : curve<G>().control_points()) {
    plain.q.push_back(splinertia::rotation(x).unit_quaternion());
    plain.p.push_back(splinertia::position(x));
  }
  for (const auto& d : curve<G>().increments()) {
    const Vector head = d.template head<3>(), tail = d.template tail<3>();
    plain.phi.push_back(SplitPose<G> ? head : tail);
    plain.rho.push_back(SplitPose<G> ? tail : head);
  }
  return plain;
}

const Quaternion q_BI = rotation_exp<double>(Vector(0.1, -0.2, 0.3));
const Vector p_BI(0.1, 0.2, -0.3);

template <typename G>
Mounted<G> mounted() {
  return {curve<G>(), standard_gravity<double>(), {rotation_from_unit_quaternion(q_BI), p_BI}};
}

template <typename G>
PlainMounted plain_mounted() {
  return {plain_poses<G>(), standard_gravity<double>(), q_BI, p_BI};
}

}  // namespace
