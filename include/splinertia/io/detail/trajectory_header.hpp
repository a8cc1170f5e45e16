// SPDX-License-Identifier: MIT
/// Reads the line of a trajectory file that names its columns, in many spellings.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <splinertia/io/detail/trajectory_columns.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// A name of a column and the unit in brackets behind it.
struct HeaderName {
  std::string name, unit;
};

/// Splits a header at its commas, or at its blanks if it has none. Names become lower case, with _ for . / : - and
/// blanks. A text in [] or () is the unit of the name before it.
[[nodiscard]] inline std::vector<HeaderName> split_header(std::string_view line) {
  while (!line.empty() && std::string_view("#%/ \t").find(line.front()) != std::string_view::npos)
    line.remove_prefix(1);
  const bool commas = line.find(',') != std::string_view::npos;
  std::vector<HeaderName> names(1);
  const auto begin_next = [&] {
    while (names.back().name.ends_with('_')) names.back().name.pop_back();
    names.emplace_back();
  };
  bool in_unit = false;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t';
    if (c == ']' || c == ')') {
      in_unit = false;
    } else if (c == '[' || c == '(') {
      in_unit = true;
      if (names.back().name.empty() && names.size() > 1 && !commas) names.pop_back();  // "t [s]"
    } else if (in_unit) {
      names.back().unit += c;
    } else if (c == ',' || (blank && !commas)) {
      if (commas || !names.back().name.empty()) begin_next();
    } else if (c >= 'A' && c <= 'Z') {
      names.back().name += static_cast<char>(c - 'A' + 'a');
    } else if (blank || std::string_view("./:-").find(c) != std::string_view::npos) {
      if (!names.back().name.empty()) names.back().name += '_';
    } else if (c != '"' && c != '\'') {
      names.back().name += c;
    }
  }
  begin_next();
  while (!names.empty() && names.back().name.empty()) names.pop_back();
  return names;
}

[[nodiscard]] inline std::optional<TimeUnit> time_unit_of(std::string_view text) {
  using Names = std::initializer_list<std::string_view>;
  const auto is_one_of = [text](Names names) { return std::find(names.begin(), names.end(), text) != names.end(); };
  if (is_one_of({"s", "sec", "secs", "second", "seconds"})) return TimeUnit::seconds;
  if (is_one_of({"ms", "msec", "milliseconds"})) return TimeUnit::milliseconds;
  if (is_one_of({"us", "usec", "microseconds", "µs", "μs"})) return TimeUnit::microseconds;
  if (is_one_of({"ns", "nsec", "nsecs", "nanosec", "nanoseconds"})) return TimeUnit::nanoseconds;
  return std::nullopt;
}

/// Whether a name is that of the time. Sets `unit` if the name ends in one (timestamp_ns) or has one in brackets.
[[nodiscard]] inline bool is_time_name(const HeaderName& column, std::optional<TimeUnit>& unit) {
  std::string_view name = column.name;
  if (const std::size_t last = name.rfind('_'); last != std::string_view::npos) {
    if (const auto suffix = time_unit_of(name.substr(last + 1))) {
      unit = suffix;
      name = name.substr(0, last);
    }
  }
  if (const auto in_brackets = time_unit_of(column.unit)) unit = in_brackets;
  constexpr std::array<std::string_view, 7> known{"t", "time", "times", "timestamp", "timestamps", "stamp", "ts"};
  return std::find(known.begin(), known.end(), name) != known.end() || name.ends_with("header_stamp");
}

/// What a column with this name holds, the time excepted; column::ignored if the name is not known.
[[nodiscard]] inline std::size_t place_of_name(std::string_view name) {
  if (name.empty()) return column::ignored;
  const std::size_t axis = std::string_view("xyzw").find(name.back());
  if (axis == std::string_view::npos) return column::ignored;
  name.remove_suffix(1);
  if (name.ends_with('_')) name.remove_suffix(1);
  using Names = std::initializer_list<std::string_view>;
  const auto is_one_of = [name](Names names) { return std::find(names.begin(), names.end(), name) != names.end(); };
  const auto ends_in = [name](Names ends) {
    return std::any_of(ends.begin(), ends.end(), [name](std::string_view end) { return name.ends_with(end); });
  };
  if (is_one_of({"q", "quat", "quaternion", "orientation", "ori", "rotation", "rot"}) || name.starts_with("q_") ||
      ends_in({"_q", "_quat", "_quaternion", "_orientation", "_rotation"}) || (axis == 3 && name.empty())) {
    return column::quaternion + axis;
  }
  if (axis == 3) return column::ignored;
  if (is_one_of({"", "t", "p", "pos", "position", "translation", "trans"}) || name.starts_with("p_") ||
      ends_in({"_pos", "_position", "_translation"})) {
    return column::position + axis;
  }
  if (is_one_of({"v", "vel", "velocity", "v_w", "v_rs_r", "v_ws_w", "v_wb_w"})) return column::velocity + axis;
  if (is_one_of({"bw", "bg", "b_w", "b_g", "gyro_bias", "gyroscope_bias", "bias_gyro", "bias_w", "bias_g"}) ||
      name.starts_with("b_w_") || name.starts_with("b_g_")) {
    return column::gyro_bias + axis;
  }
  if (is_one_of({"ba", "b_a", "accel_bias", "acc_bias", "accelerometer_bias", "bias_accel", "bias_acc", "bias_a"}) ||
      name.starts_with("b_a_")) {
    return column::accel_bias + axis;
  }
  return column::ignored;
}

/// What a line says about the columns.
struct Header {
  ColumnPlan plan;
  std::optional<TimeUnit> unit{};  // of the time
  std::string repeated{};          // a column that it names twice
  std::size_t known = 0;           // how many names were understood
  bool asl = false;                // EuRoC's own names, whose times are ns

  [[nodiscard]] bool complete() const { return plan.has_pose() && repeated.empty(); }
};

/// "timestamp(s) q p v bg ba …", as OpenVINS names vectors.
[[nodiscard]] inline bool names_openvins_states(const std::vector<HeaderName>& names) {
  constexpr std::array<std::string_view, 5> vectors{"q", "p", "v", "bg", "ba"};
  return names.size() > vectors.size() &&
         std::equal(vectors.begin(), vectors.end(), names.begin() + 1,
                    [](std::string_view vector, const HeaderName& column) { return column.name == vector; });
}

/// Reads a line as names of columns. A ROS message has two times; that of its header is used.
[[nodiscard]] inline Header read_header(std::string_view line) {
  const std::vector<HeaderName> names = split_header(line);
  Header header;
  if (names_openvins_states(names)) {
    for (const KnownTrajectoryFormat& known : known_trajectory_formats) {
      if (known.kind == TrajectoryFormat::Kind::openvins) header.plan = parse_columns(known.columns);
    }
    header.known = names.size();
    std::optional<TimeUnit> unit;
    if (is_time_name(names[0], unit)) header.unit = unit;
    return header;
  }
  const bool ros = std::any_of(names.begin(), names.end(),
                               [](const HeaderName& column) { return column.name.ends_with("header_stamp"); });
  for (const HeaderName& column : names) {
    std::optional<TimeUnit> unit;
    std::size_t place = place_of_name(column.name);
    if (is_time_name(column, unit) && (!ros || column.name.ends_with("header_stamp"))) {
      place = column::time;
      header.unit = unit;
    }
    if (place != column::ignored && header.plan.has(place)) header.repeated = trajectory_column_names[place];
    if (place != column::ignored) ++header.known;
    header.asl = header.asl || column.name.find("_rs_") != std::string::npos;
    header.plan.places.push_back(place);
  }
  header.plan.drop_incomplete_vectors();
  return header;
}

}  // namespace splinertia::detail
