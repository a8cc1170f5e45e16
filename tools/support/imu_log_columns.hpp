// SPDX-License-Identifier: MIT
// The columns of one IMU log: a table of numbers or a ROS bag.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <splinertia/io/trajectory_format.hpp>
#include <string>
#include <string_view>
#include <vector>

/// What a column can hold: the time, the gyroscope, the accelerometer.
inline constexpr std::array<std::string_view, 7> imu_column_names{"t", "gx", "gy", "gz", "ax", "ay", "az"};

/// How to read one log. The names of its options are used in messages.
struct ImuTable {
  std::filesystem::path path;
  std::vector<std::string> columns;                     ///< of imu_column_names, or - for a column to ignore
  std::optional<double> rate;                           ///< Hz, if there is no column t
  std::optional<splinertia::TimeUnit> time_unit;        ///< as given
  std::optional<splinertia::TimeUnit> usual_time_unit;  ///< of the format, if it has one
  bool drop_duplicates = false;                         ///< rows whose stamp equals that of the row before
  std::optional<std::string> topic;                     ///< of a ROS bag
  std::string python;                                   ///< interpreter for reading a ROS bag
  std::string columns_option = "--columns", rate_option = "--rate";
};

/// The content of a log.
struct ImuColumns {
  std::vector<std::chrono::nanoseconds> times;
  std::array<std::vector<double>, imu_column_names.size()> values;  ///< the first is unused; empty: no such column
  std::size_t rows = 0;
  splinertia::TimeUnit time_unit = splinertia::TimeUnit::nanoseconds;  ///< of the stamps in the log
  std::string unit_note;                                               ///< why it is not the usual unit; may be empty
  std::size_t duplicates = 0;                                          ///< rows that were dropped
  std::optional<std::string> topic;                                    ///< of the bag

  /// Removes the rows from `first` to before `last`.
  void erase(std::size_t first, std::size_t last);
};

/// Reads a log. Throws as read_imu_log().
[[nodiscard]] ImuColumns read_imu_columns(const ImuTable& table);
