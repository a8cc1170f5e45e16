// SPDX-License-Identifier: MIT
/// One motion in many dresses, for the tests of read_trajectory.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <splinertia/io/trajectory.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace splinertia::test {

/// Pose i of a motion that turns about all axes.
inline Stamped<SO3xR3<double>> dressed_pose(std::int64_t time, int i) {
  const double t = 0.005 * i;
  const Eigen::Quaterniond q = Eigen::AngleAxisd(0.7 * t, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(0.3 + 0.2 * std::sin(t), Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(0.4 * std::sin(2 * t), Eigen::Vector3d::UnitX());
  return {std::chrono::nanoseconds{time},
          {rotation_from_unit_quaternion<double>(q), Eigen::Vector3d(std::sin(t), std::cos(t), 0.1 * t)}};
}

inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// How the rows of a file are written.
struct Dress {
  std::string header = "";
  std::string separator = " ";
  QuaternionOrder order = QuaternionOrder::xyzw;
  TimeUnit unit = TimeUnit::seconds;
  std::string tail = "";
  std::string line_end = "\n";
  int rows = 50;
  std::int64_t start = 1'600'000'000'000'000'000;                 // ns
  std::int64_t step = 5'000'000;                                  // ns
  std::function<std::string(int)> stamp = {};                     // instead of start, step and unit
  std::function<std::string(const std::string&, int)> edit = {};  // of each row
};

inline std::vector<Stamped<SO3xR3<double>>> dressed_poses(const Dress& dress = {}) {
  std::vector<Stamped<SO3xR3<double>>> poses;
  for (int i = 0; i < dress.rows; ++i) poses.push_back(dressed_pose(dress.start + i * dress.step, i));
  return poses;
}

inline std::string text_of(const Dress& dress) {
  std::string text = dress.header.empty() ? "" : dress.header + dress.line_end;
  int i = 0;
  for (const auto& [time, pose] : dressed_poses(dress)) {
    const Eigen::Quaterniond& q = rotation(pose).unit_quaternion();
    const Eigen::Vector3d& p = position(pose);
    std::vector<double> values{p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
    if (dress.order == QuaternionOrder::wxyz) values = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
    std::string row = dress.stamp ? dress.stamp(i) : detail::stamp_text(time, dress.unit);
    if (!dress.stamp && dress.unit == TimeUnit::seconds && row.find('.') == std::string::npos) row += ".0";
    for (const double value : values) row += dress.separator + number(value);
    row += dress.tail;
    text += (dress.edit ? dress.edit(row, i) : row) + dress.line_end;
    ++i;
  }
  return text;
}

/// Whether poses agree to within rounding.
inline bool near_all(const auto& a, const auto& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].time != b[i].time || (position(a[i].value) - position(b[i].value)).norm() > 1e-12) return false;
    if (increment(rotation(a[i].value), rotation(b[i].value)).norm() > 1e-6) return false;
  }
  return true;
}

/// Whether one of the notes has a text in it.
inline bool notes(const TrajectoryFile& file, std::string_view text) {
  for (const std::string& note : file.notes) {
    if (note.find(text) != std::string::npos) return true;
  }
  return false;
}

}  // namespace splinertia::test
