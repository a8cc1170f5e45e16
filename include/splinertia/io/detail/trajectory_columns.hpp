// SPDX-License-Identifier: MIT
/// What the columns of a trajectory file hold, as lists of names.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace splinertia::detail {

/// The names of what a column can hold. The value of a column is stored at the index of its name.
inline constexpr std::array<std::string_view, 26> trajectory_column_names{
    "t",   "x",   "y",   "z",   "qx",  "qy",  "qz",  "qw",  "vx",  "vy",  "vz",  "bgx", "bgy",
    "bgz", "bax", "bay", "baz", "r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"};

/// The index of the first name of each kind in trajectory_column_names, and that of an ignored column.
namespace column {
inline constexpr std::size_t time = 0, position = 1, quaternion = 4, velocity = 8, gyro_bias = 11, accel_bias = 14,
                             matrix = 17, ignored = 26;
}  // namespace column

/// What each column of a row holds.
struct ColumnPlan {
  std::vector<std::size_t> places;  // by column: index in trajectory_column_names
  bool more = false;                // rows may have more columns behind these

  [[nodiscard]] bool has(std::size_t first, std::size_t count = 1) const {
    for (std::size_t i = first; i < first + count; ++i) {
      if (std::find(places.begin(), places.end(), i) == places.end()) return false;
    }
    return true;
  }
  [[nodiscard]] bool has_pose() const {
    return has(column::position, 3) && (has(column::quaternion, 4) || has(column::matrix, 9));
  }

  /// "t,x,y,z,…"
  [[nodiscard]] std::string text() const {
    std::string result;
    for (const std::size_t place : places) {
      if (!result.empty()) result += ',';
      result += place == column::ignored ? "-" : trajectory_column_names[place];
    }
    return more ? result + ",..." : result;
  }

  /// Ignores vectors that are incomplete, such as a velocity without vz.
  void drop_incomplete_vectors() {
    for (const std::size_t first : {column::velocity, column::gyro_bias, column::accel_bias}) {
      if (has(first, 3)) continue;
      for (std::size_t& place : places) {
        if (place >= first && place < first + 3) place = column::ignored;
      }
    }
  }

  /// Puts the columns of the quaternion in this order.
  void set_order(QuaternionOrder order) {
    constexpr std::size_t x = column::quaternion, y = x + 1, z = x + 2, w = x + 3;
    const std::array<std::size_t, 4> wanted =
        order == QuaternionOrder::wxyz ? std::array{w, x, y, z} : std::array{x, y, z, w};
    std::size_t next = 0;
    for (std::size_t& place : places) {
      if (place >= x && place <= w) place = wanted[next++];
    }
  }
};

/// Parses a list of names. Throws std::invalid_argument, whose message names the option --columns, for an unknown or
/// repeated name, for a list without a pose, and for an incomplete vector.
[[nodiscard]] inline ColumnPlan parse_columns(std::string_view list) {
  constexpr std::string_view expected = "expected names such as t,x,y,z,qx,qy,qz,qw, and - for columns to ignore";
  ColumnPlan plan;
  std::vector<std::string_view> names;
  split_fields(list, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "..." && i + 1 == names.size()) {
      plan.more = true;
      break;
    }
    const auto found = std::find(trajectory_column_names.begin(), trajectory_column_names.end(), names[i]);
    const auto place = static_cast<std::size_t>(found - trajectory_column_names.begin());
    if (place == column::ignored && names[i] != "-") {
      throw std::invalid_argument(message("--columns: ", excerpt(names[i]), " is not a column, ", expected));
    }
    if (place != column::ignored && plan.has(place)) {
      throw std::invalid_argument(message("--columns: ", names[i], " appears twice, expected once"));
    }
    plan.places.push_back(place);
  }
  if (!plan.has_pose()) {
    throw std::invalid_argument(message("--columns: ", excerpt(list, 80),
                                        " is not a pose, expected x, y, z and qx, qy, qz, qw (or r11 to r33)"));
  }
  for (const std::size_t first : {column::velocity, column::gyro_bias, column::accel_bias}) {
    if (!plan.has(first, 3) && (plan.has(first) || plan.has(first + 1) || plan.has(first + 2))) {
      throw std::invalid_argument(message("--columns: ", excerpt(list, 80), " has only part of ",
                                          trajectory_column_names[first], ' ', trajectory_column_names[first + 1], ' ',
                                          trajectory_column_names[first + 2], ", expected all or none"));
    }
  }
  return plan;
}

}  // namespace splinertia::detail
