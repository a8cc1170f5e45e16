// SPDX-License-Identifier: MIT
/// The good rows of a trajectory file, and what was wrong with the others.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <splinertia/detail/message.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/io/detail/quaternion_track.hpp>
#include <splinertia/io/detail/trajectory_columns.hpp>
#include <splinertia/io/detail/trajectory_layout.hpp>
#include <splinertia/io/detail/trajectory_row.hpp>
#include <splinertia/io/detail/trajectory_stamps.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// Collects the good rows of one file, and counts the bad ones.
class TrajectoryTable {
 public:
  TrajectoryTable(std::string path, TrajectoryLayout chosen) : layout(std::move(chosen)), path_(std::move(path)) {
    has_velocity_ = layout.plan.has(column::velocity, 3);
    has_gyro_bias_ = layout.plan.has(column::gyro_bias, 3);
    has_accel_bias_ = layout.plan.has(column::accel_bias, 3);
  }

  void add(const RowReader& row, std::chrono::nanoseconds time, std::size_t line) {
    poses.push_back({time, {track_.next(row.attitude()), row.vector(column::position)}});
    lines.push_back(line);
    if (has_velocity_) velocities.push_back(row.vector(column::velocity));
    if (has_gyro_bias_) gyro_biases.push_back(row.vector(column::gyro_bias));
    if (has_accel_bias_) accel_biases.push_back(row.vector(column::accel_bias));
  }

  /// Reserves memory for all rows, given that `rows` took the share `progress` of the file.
  void expect_rows(std::size_t rows, double progress) {
    if (poses.capacity() > poses.size() + 4096 || !(progress > 0)) return;
    const auto expected = static_cast<std::size_t>(1.02 * static_cast<double>(rows) / progress);
    poses.reserve((std::max)(expected, 2 * poses.size()));
    lines.reserve(poses.capacity());
    if (has_velocity_) velocities.reserve(poses.capacity());
    if (has_gyro_bias_) gyro_biases.reserve(poses.capacity());
    if (has_accel_bias_) accel_biases.reserve(poses.capacity());
  }

  void add_bad(BadRow bad) {
    ++counts_[static_cast<std::size_t>(bad.fault)];
    const auto place = std::partition_point(first_bad_.begin(), first_bad_.end(),
                                            [&](const BadRow& other) { return other.line < bad.line; });
    first_bad_.insert(place, std::move(bad));
    if (first_bad_.size() > most_named) first_bad_.pop_back();
  }

  [[nodiscard]] std::size_t bad_rows() const { return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0}); }

  /// Moves the rows with wrong stamps to the bad ones.
  void remove_wrong_stamps() {
    const auto follows = [](const auto& a, const auto& b) { return !(a.time < b.time); };
    if (std::adjacent_find(poses.begin(), poses.end(), follows) != poses.end()) remove_out_of_order();
    const FarStamps distant(times());
    if (distant.first + distant.last > 0) remove_far(distant);
  }

  /// Throws std::runtime_error about the bad rows: the first few, and how many there are.
  [[noreturn]] void refuse_bad_rows() const {
    const std::size_t bad = bad_rows(), all = bad + poses.size();
    std::string text = message(path_, ':', first_bad_.front().line, ": ", first_bad_.front().why);
    if (bad > 1) {
      text += message("; ", bad, " of ", all, " rows are bad");
      for (std::size_t i = 1; i < first_bad_.size(); ++i) {
        text += message(i == 1 ? ": line " : ", line ", first_bad_[i].line, ": ", first_bad_[i].why);
      }
      if (bad > first_bad_.size()) text += ", …";
    }
    throw std::runtime_error(text + (poses.empty() ? "" : " (--skip-bad-rows leaves such rows out)"));
  }

  /// "2 rows left out: 1 malformed, 1 with a stamp out of order; the first is line 7: …"
  [[nodiscard]] std::string skipped_text() const {
    std::string kinds;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] > 0) kinds += message(kinds.empty() ? "" : ", ", counts_[i], ' ', row_fault_names[i]);
    }
    return message(bad_rows(), bad_rows() == 1 ? " row" : " rows", " left out: ", kinds, "; the first is line ",
                   first_bad_.front().line, ": ", first_bad_.front().why);
  }

  /// Throws std::runtime_error if the poses span more than 64-bit nanoseconds hold, if a step is longer than ten years,
  /// or if the rate is not plausible for poses and the unit is not given by the user.
  void require_sane_times() const {
    if (poses.size() < 2) return;
    const auto text = [&](std::size_t i) { return message(stamp_text(poses[i].time, layout.unit), unit_text()); };
    const std::size_t last = poses.size() - 1;
    if (stamp_distance(poses[0].time, poses[last].time) > std::uint64_t{(std::numeric_limits<std::int64_t>::max)()}) {
      throw std::runtime_error(message(path_, ": the poses span more than 292 years, from ", text(0), " in line ",
                                       lines[0], " to ", text(last), " in line ", lines[last]));
    }
    std::vector<double> steps(last);
    for (std::size_t i = 0; i < last; ++i) steps[i] = static_cast<double>((poses[i + 1].time - poses[i].time).count());
    const auto largest = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
    constexpr double ten_years = 3.2e17;  // ns
    if (steps[largest] > ten_years) {
      throw std::runtime_error(message(path_, ':', lines[largest], ": stamps step from ", text(largest), " to ",
                                       text(largest + 1), " in line ", lines[largest + 1],
                                       ": more than ten years, expected the poses of one recording"));
    }
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(last / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    const double step = *middle * 1e-9 / seconds_of(layout.unit);
    if (!layout.unit_given && layout.plan.has(column::time) && !is_plausible(step, layout.unit)) {
      throw std::runtime_error(message(path_, ':', lines[0], ": stamps in ", time_unit_name(layout.unit),
                                       " give an implausible rate: the poses would have ", rates_text(step),
                                       "; give --time-unit s, ms, us or ns"));
    }
  }

  TrajectoryLayout layout;
  std::vector<Stamped<SO3xR3<double>>> poses;
  std::vector<std::size_t> lines;  // of the poses
  std::vector<Eigen::Vector3d> velocities, gyro_biases, accel_biases;

 private:
  static constexpr std::size_t most_named = 5;

  [[nodiscard]] std::string unit_text() const { return message(' ', time_unit_name(layout.unit)); }

  [[nodiscard]] std::vector<std::chrono::nanoseconds> times() const {
    std::vector<std::chrono::nanoseconds> result;
    result.reserve(poses.size());
    for (const auto& pose : poses) result.push_back(pose.time);
    return result;
  }

  void remove_out_of_order() {
    const std::vector<std::chrono::nanoseconds> all = times();
    const std::vector<std::size_t> left_out = out_of_order(all);
    std::vector<bool> out(all.size());
    for (const std::size_t i : left_out) out[i] = true;
    const auto text = [&](std::size_t i) { return message(stamp_text(all[i], layout.unit), unit_text()); };
    for (const std::size_t i : left_out) {
      std::size_t before = i, after = i;  // the nearest rows that stay
      while (before > 0 && out[before]) --before;
      while (after + 1 < all.size() && out[after]) ++after;
      const bool duplicate = (!out[before] && all[before] == all[i]) || (!out[after] && all[after] == all[i]);
      const bool behind = !out[before] && all[before] >= all[i];
      add_bad({lines[i], duplicate ? RowFault::duplicate : RowFault::backward,
               behind ? message("time ", text(i), " follows ", text(before), " in line ", lines[before],
                                ", expected increasing times")
                      : message("time ", text(i), " comes before ", text(after), " in line ", lines[after],
                                ", expected increasing times")});
    }
    remove(out);
  }

  void remove_far(const FarStamps& distant) {
    const std::size_t n = poses.size();
    std::vector<bool> out(n);
    const auto text = [&](std::size_t i) { return message(stamp_text(poses[i].time, layout.unit), unit_text()); };
    const std::size_t first = distant.first, last = n - 1 - distant.last;  // of those that stay
    const std::string span = stamp_text(poses[last].time - poses[first].time, TimeUnit::seconds);
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = i < first || i > last;
      if (!out[i]) continue;
      const std::size_t from = i < first ? first - 1 : last;
      add_bad({lines[i], RowFault::distant,
               message("stamps step from ", text(from), " to ", text(from + 1), " in line ", lines[from + 1],
                       ", the rest span ", span, " s")});
    }
    remove(out);
  }

  void remove(const std::vector<bool>& out) {
    const auto compress = [&out](auto& values) {
      if (values.empty()) return;
      std::size_t kept = 0;
      for (std::size_t i = 0; i < out.size(); ++i) {
        if (!out[i]) values[kept++] = values[i];
      }
      values.resize(kept);
    };
    compress(poses);
    compress(lines);
    compress(velocities);
    compress(gyro_biases);
    compress(accel_biases);
    QuaternionTrack track;
    for (auto& pose : poses) pose.value = {track.next(rotation(pose.value).unit_quaternion()), position(pose.value)};
  }

  std::string path_;
  bool has_velocity_ = false, has_gyro_bias_ = false, has_accel_bias_ = false;
  QuaternionTrack track_;
  std::array<std::size_t, row_fault_names.size()> counts_{};
  std::vector<BadRow> first_bad_;  // in order of lines
};

}  // namespace splinertia::detail
