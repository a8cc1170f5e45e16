// SPDX-License-Identifier: MIT
#include "dead_reckon/truth.hpp"

#include <algorithm>
#include <filesystem>
#include <splinertia/io/euroc.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/io/trajectory.hpp>
#include <splinertia/message.hpp>
#include <stdexcept>
#include <string_view>

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

TrueStates states_of(const std::vector<EurocState>& states) {
  TrueStates result{{}, true};
  for (const EurocState& s : states) {
    result.rows.push_back({{rotation(s.pose), s.velocity, position(s.pose), s.time}, {s.gyro_bias, s.accel_bias}});
  }
  return result;
}

/// Velocities are those of the parabola through a pose and its neighbours; a pose without two near ones is left out.
TrueStates states_of(const std::vector<Stamped<SO3xR3<double>>>& poses, double longest_gap) {
  TrueStates result{{}, false};
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    const auto& [t0, x0] = poses[i - 1];
    const auto& [t1, x1] = poses[i];
    const auto& [t2, x2] = poses[i + 1];
    const double h0 = seconds<double>(t1 - t0), h1 = seconds<double>(t2 - t1);
    if (h0 > longest_gap || h1 > longest_gap) continue;
    const Eigen::Vector3d v0 = (position(x1) - position(x0)) / h0, v1 = (position(x2) - position(x1)) / h1;
    result.rows.push_back({{rotation(x1), (h1 * v0 + h0 * v1) / (h0 + h1), position(x1), t1}, ImuBias<double>{}});
  }
  return result;
}

/// Whether every row of a EuRoC file has velocities and biases: readers see to it that all are of one length.
bool has_states(const std::filesystem::path& path) {
  TextFile file(path);
  std::vector<std::string_view> fields;
  if (file.next()) split_fields(file.line(), fields);
  return fields.size() == euroc_groundtruth_columns.size();
}

}  // namespace

TrueStates read_truth(const Options& o) {
  const bool euroc = recognize_trajectory(o.trajectory) == TrajectoryFormat::euroc;
  const TrueStates truth = euroc && has_states(o.trajectory) ? states_of(read_euroc_groundtruth(o.trajectory))
                                                             : states_of(read_trajectory(o.trajectory), o.longest_gap);
  if (truth.rows.empty()) {
    throw std::runtime_error(message(o.trajectory.string(), ": expected three poses in a row that are at most ",
                                     o.longest_gap, " s apart, to have a velocity (--longest-gap)"));
  }
  return truth;
}

std::optional<Truth> at(const TrueStates& truth, nanoseconds time, double longest_gap) {
  const auto& rows = truth.rows;
  const auto after = std::ranges::lower_bound(rows, time, {}, [](const Truth& row) { return row.state.time; });
  if (after == rows.end()) return std::nullopt;
  if (after->state.time == time) return *after;
  if (after == rows.begin()) return std::nullopt;
  const State &a = (after - 1)->state, &b = after->state;
  const ImuBias<double>&bias_a = (after - 1)->bias, &bias_b = after->bias;
  const double h = seconds<double>(b.time - a.time);
  if (h > longest_gap) return std::nullopt;
  const double s = seconds<double>(time - a.time) / h, r = 1 - s;
  const auto mix = [s, r](const Eigen::Vector3d& x, const Eigen::Vector3d& y) -> Eigen::Vector3d {
    return r * x + s * y;
  };
  const Sophus::SO3d R_WB = a.R_WB * GroupTraits<Sophus::SO3d>::exp(s * increment(a.R_WB, b.R_WB));
  const Eigen::Vector3d p_WB = a.p_WB + s * s * (1 + 2 * r) * (b.p_WB - a.p_WB) + h * s * r * (r * a.v_WB - s * b.v_WB);
  return Truth{{R_WB, mix(a.v_WB, b.v_WB), p_WB, time},
               {mix(bias_a.gyro, bias_b.gyro), mix(bias_a.accel, bias_b.accel)}};
}

State imu_state(const State& body, const LeverArm<double>& arm, const Eigen::Vector3d& omega) {
  State imu = body;
  imu.R_WB = body.R_WB * arm.R_BI;
  imu.p_WB += body.R_WB * arm.p_BI;
  imu.v_WB += body.R_WB * omega.cross(arm.p_BI);
  return imu;
}
