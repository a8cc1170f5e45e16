// SPDX-License-Identifier: MIT
/// Reads trajectories in any of the known formats, or in a format that is described.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <splinertia/detail/message.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/io/detail/trajectory_columns.hpp>
#include <splinertia/io/detail/trajectory_head.hpp>
#include <splinertia/io/detail/trajectory_layout.hpp>
#include <splinertia/io/detail/trajectory_row.hpp>
#include <splinertia/io/detail/trajectory_stamps.hpp>
#include <splinertia/io/detail/trajectory_table.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinertia {

/// The contents of a trajectory file. Velocities and biases have one element for each pose, or none.
struct TrajectoryFile {
  std::vector<Stamped<SO3xR3<double>>> poses{};  ///< T_WB [m], times increasing
  std::vector<Eigen::Vector3d> velocities{};     ///< in W [m/s]
  std::vector<Eigen::Vector3d> gyro_biases{};    ///< in B [rad/s]
  std::vector<Eigen::Vector3d> accel_biases{};   ///< in B [m/s²]
  std::vector<std::string> notes{};              ///< what was inferred or assumed, a sentence each, for people to read
};

namespace detail {

/// The stamps in a file with one per line. The unit is the given one, or chosen as for poses with seconds as usual
/// unit.
[[nodiscard]] inline std::vector<std::chrono::nanoseconds> read_times(const TrajectoryFormat& format,
                                                                      std::vector<std::string>& notes) {
  TextFile file(format.times);
  std::vector<NumberedLine> lines;
  while (file.next()) lines.push_back({file.line_number(), std::string(file.line())});
  std::vector<std::string_view> first;
  for (const NumberedLine& line : lines) {
    if (first.size() == TrajectoryHead::most_rows) break;
    first.push_back(line.text);
  }
  const TimeUnit unit = choose_time_unit(StampSample(first), format.time_unit, std::nullopt, TimeUnit::seconds,
                                         message(file.path(), ": "), notes);
  std::vector<std::chrono::nanoseconds> times;
  for (const NumberedLine& line : lines) {
    const auto time = parse_time(line.text, static_cast<int>(unit));
    if (time.problem) {
      throw std::runtime_error(message(file.path(), ':', line.number, ": ", excerpt(line.text), ' ', time.problem,
                                       ", expected a time [", time_unit_name(unit), "]"));
    }
    times.push_back(time.value);
  }
  return times;
}

/// The times of the rows of a file without stamps.
class RowTimes {
 public:
  RowTimes(const TrajectoryFormat& format, TrajectoryLayout& layout) : rate_(format.rate), times_file_(format.times) {
    if (times_file_.empty()) return;
    times_ = read_times(format, layout.notes);
    layout.unit = TimeUnit::seconds;
  }

  [[nodiscard]] std::chrono::nanoseconds operator[](std::size_t row) const {
    if (rate_) return at_rate(row);
    return row < times_.size() ? times_[row] : std::chrono::nanoseconds{};
  }

  [[nodiscard]] std::chrono::nanoseconds at_rate(std::size_t row) const {
    const double time = static_cast<double>(row) / *rate_, most = 9e9;  // s; 64 bits of nanoseconds are 9.2e9
    if (time <= most) return to_ticks<std::chrono::nanoseconds>(time);
    throw std::invalid_argument(
        message("--pose-rate: at ", *rate_, " Hz the time of row ", row, " is ", time, " s, expected at most ", most));
  }

  void require_rows(const TextFile& file, std::size_t rows) const {
    if (times_file_.empty() || rows == times_.size()) return;
    throw std::runtime_error(message(times_file_.string(), ": ", times_.size(), " times for the ", rows, " rows of ",
                                     file.path(), ", expected one for each row"));
  }

 private:
  std::optional<double> rate_;
  std::filesystem::path times_file_;
  std::vector<std::chrono::nanoseconds> times_;
};

/// Reads all rows: those of the head, then the rest of the file.
[[nodiscard]] inline TrajectoryTable read_rows(TextFile& file, const TrajectoryHead& head, TrajectoryLayout layout,
                                               const TrajectoryFormat& format) {
  const bool stamps = layout.plan.has(column::time);
  const RowTimes times(format, layout);
  RowReader reader(layout);
  TrajectoryTable table(file.path(), std::move(layout));
  std::size_t row = 0;
  const auto add = [&](std::string_view line, std::size_t number) {
    if (auto bad = reader.read(line, number)) {
      table.add_bad(std::move(*bad));
    } else {
      table.add(reader, stamps ? reader.time() : times[row], number);
    }
    ++row;
  };
  for (const NumberedLine& line : head.rows) add(line.text, line.number);
  while (file.next()) {
    if (row % 4096 == 0) table.expect_rows(row, file.progress());
    add(file.line(), file.line_number());
  }
  if (!stamps) times.require_rows(file, row);
  return table;
}

/// Drops velocities that are all zero, and biases if they are all zero as well: writers without velocities write zeros.
inline void drop_zero_velocities(TrajectoryFile& result) {
  const auto zero = [](const Eigen::Vector3d& v) { return v.isZero(0); };
  if (result.velocities.empty() || !std::all_of(result.velocities.begin(), result.velocities.end(), zero)) return;
  result.velocities.clear();
  const auto all_zero = [&](const auto& biases) { return std::all_of(biases.begin(), biases.end(), zero); };
  const bool biases = !result.gyro_biases.empty() && all_zero(result.gyro_biases) && all_zero(result.accel_biases);
  if (biases) {
    result.gyro_biases.clear();
    result.accel_biases.clear();
  }
  result.notes.push_back(
      message("velocities", biases ? " and biases" : "", " are all zero: the file is read as if it had none"));
}

}  // namespace detail

/// Reads the poses T_WB [m] of a trajectory file, and velocities and biases if it has them. The file is opened once and
/// may be a pipe. What the format leaves open is inferred from the names of the columns, the number of columns and the
/// stamps; the notes say what was inferred.
///
/// The order of a quaternion cannot be inferred from the motion: read in the other order, R becomes A R⁻¹ B with
/// constant A and B, which is as smooth. It has to come from a header, from a format with a single order, or from the
/// user.
///
/// Throws std::runtime_error with file:line for errors in the file. If something cannot be inferred, the message names
/// the option that sets it. If rows are bad, it names the first ones and their number; skip_bad_rows leaves them out.
/// Throws std::invalid_argument for a format that contradicts itself or the file.
[[nodiscard]] inline TrajectoryFile read_trajectory(const std::filesystem::path& path,
                                                    const TrajectoryFormat& format = {}) {
  TextFile file(path);
  const detail::TrajectoryHead head(file);
  detail::TrajectoryTable table =
      detail::read_rows(file, head, detail::LayoutChoice(file, head, format).choose(), format);
  table.remove_wrong_stamps();
  TrajectoryFile result;
  result.notes = std::move(table.layout.notes);
  if (table.bad_rows() > 0) {
    if (!format.skip_bad_rows || table.poses.empty()) table.refuse_bad_rows();
    result.notes.push_back(table.skipped_text());
  }
  table.require_sane_times();
  result.poses = std::move(table.poses);
  result.velocities = std::move(table.velocities);
  result.gyro_biases = std::move(table.gyro_biases);
  result.accel_biases = std::move(table.accel_biases);
  detail::drop_zero_velocities(result);
  return result;
}

}  // namespace splinertia
