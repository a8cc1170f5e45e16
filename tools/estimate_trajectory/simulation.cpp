// SPDX-License-Identifier: MIT
#include "estimate_trajectory/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

using namespace splinertia;

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
