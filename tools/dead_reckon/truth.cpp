// SPDX-License-Identifier: MIT
#include "dead_reckon/truth.hpp"

#include <algorithm>
#include <cstddef>
#include <splinertia/io/trajectory.hpp>
#include <stdexcept>
#include <vector>

#include "support/concat.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

TrueStates states_of(const TrajectoryFile& file) {
  const bool with_biases = !file.gyro_biases.empty() && !file.accel_biases.empty();
  TrueStates result{{}, true, with_biases, {}};
  for (std::size_t i = 0; i < file.poses.size(); ++i) {
    const auto& [time, pose] = file.poses[i];
    const ImuBias<double> bias =
        with_biases ? ImuBias<double>{file.gyro_biases[i], file.accel_biases[i]} : ImuBias<double>{};
    result.rows.push_back({{rotation(pose), file.velocities[i], position(pose), time}, bias});
  }
  return result;
}

/// Velocities are those of the parabola through a pose and its two neighbours. Poses with a neighbour further than
/// `longest_gap` (s) away are left out.
TrueStates states_of(const std::vector<Stamped<SO3xR3<double>>>& poses, double longest_gap) {
  TrueStates result{{}, false, false, {}};
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    const auto& [t0, x0] = poses[i - 1];
    const auto& [t1, x1] = poses[i];
    const auto& [t2, x2] = poses[i + 1];
    const double h0 = to_seconds<double>(t1 - t0), h1 = to_seconds<double>(t2 - t1);
    if (h0 > longest_gap || h1 > longest_gap) continue;
    const Eigen::Vector3d v0 = (position(x1) - position(x0)) / h0, v1 = (position(x2) - position(x1)) / h1;
    result.rows.push_back({{rotation(x1), (h1 * v0 + h0 * v1) / (h0 + h1), position(x1), t1}, ImuBias<double>{}});
  }
  return result;
}

}  // namespace

TrueStates read_truth(const Options& o) {
  const TrajectoryFile file = read_trajectory_input(o.trajectory);
  TrueStates truth = file.velocities.empty() ? states_of(file.poses, o.longest_gap) : states_of(file);
  truth.notes = note_lines(o.trajectory, file);
  if (truth.rows.empty()) {
    throw std::runtime_error(concat(o.trajectory.file.string(), ": expected three consecutive poses at most ",
                                    o.longest_gap, " s apart, to compute a velocity (--longest-gap)"));
  }
  return truth;
}

std::optional<Truth> at(const TrueStates& truth, nanoseconds time, double longest_gap) {
  const auto& rows = truth.rows;
  const auto after = std::lower_bound(rows.begin(), rows.end(), time,
                                      [](const Truth& row, nanoseconds t) { return row.state.time < t; });
  if (after == rows.end()) return std::nullopt;
  if (after->state.time == time) return *after;
  if (after == rows.begin()) return std::nullopt;
  const State &a = (after - 1)->state, &b = after->state;
  const ImuBias<double>&bias_a = (after - 1)->bias, &bias_b = after->bias;
  const double h = to_seconds<double>(b.time - a.time);
  if (h > longest_gap) return std::nullopt;
  const double s = to_seconds<double>(time - a.time) / h, r = 1 - s;
  const auto mix = [s, r](const Eigen::Vector3d& x, const Eigen::Vector3d& y) -> Eigen::Vector3d {
    return r * x + s * y;
  };
  const Sophus::SO3d R_WB = a.R_WB * GroupTraits<Sophus::SO3d>::exp(s * increment(a.R_WB, b.R_WB));
  const Eigen::Vector3d p_WB = a.p_WB + s * s * (1 + 2 * r) * (b.p_WB - a.p_WB) + h * s * r * (r * a.v_WB - s * b.v_WB);
  return Truth{{R_WB, mix(a.v_WB, b.v_WB), p_WB, time},
               {mix(bias_a.gyro, bias_b.gyro), mix(bias_a.accel, bias_b.accel)}};
}

State imu_state(const State& body, const Mounting<double>& mounting, const Eigen::Vector3d& omega) {
  State imu = body;
  imu.R_WB = body.R_WB * mounting.R_BI;
  imu.p_WB += body.R_WB * mounting.p_BI;
  imu.v_WB += body.R_WB * omega.cross(mounting.p_BI);
  return imu;
}
