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

/// How to read one log. The names are those of the options that the program has for it, for messages.
struct ImuTable {
  std::filesystem::path path;
  std::vector<std::string> columns;                     ///< of imu_column_names, or - for what is not wanted
  std::optional<double> rate;                           ///< Hz, if there is no column t
  std::optional<splinertia::TimeUnit> time_unit;        ///< as given
  std::optional<splinertia::TimeUnit> usual_time_unit;  ///< of the format; none: it has none
  bool drop_duplicates = false;                         ///< rows whose stamp equals that of the row before
  std::optional<std::string> topic;                     ///< of a ROS bag
  std::string python;                                   ///< that reads a ROS bag
  std::string columns_option = "--columns", rate_option = "--rate";
};

/// What is in it.
struct ImuColumns {
  std::vector<std::chrono::nanoseconds> times;
  std::array<std::vector<double>, imu_column_names.size()> values;  ///< the first is unused; empty: not there
  std::size_t rows = 0;
  splinertia::TimeUnit time_unit = splinertia::TimeUnit::nanoseconds;  ///< that the stamps were in
  std::string unit_note;                                               ///< why, if the format does not say so
  std::size_t duplicates = 0;                                          ///< rows that were dropped
  std::optional<std::string> topic;                                    ///< of the bag

  /// Removes the rows from `first` to before `last`.
  void erase(std::size_t first, std::size_t last);
};

/// Reads it. Throws as read_imu_log.
[[nodiscard]] ImuColumns read_imu_columns(const ImuTable& table);
