// SPDX-License-Identifier: MIT
/// Reads the rows of a trajectory file.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/detail/quaternion_track.hpp>
#include <splinertia/io/detail/trajectory_columns.hpp>
#include <splinertia/io/detail/trajectory_head.hpp>
#include <splinertia/io/detail/trajectory_layout.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace splinertia::detail {

/// Why a row is bad.
enum class RowFault { malformed, not_finite, not_unit, duplicate, backward, distant };

inline constexpr std::array<std::string_view, 6> row_fault_names{"malformed",
                                                                 "with NaN or infinity",
                                                                 "with no unit quaternion or rotation matrix",
                                                                 "with the stamp of another row",
                                                                 "with a stamp out of order",
                                                                 "with a stamp far from all others"};

struct BadRow {
  std::size_t line;
  RowFault fault;
  std::string why;
};

/// Parses one row after the other.
class RowReader {
 public:
  explicit RowReader(const TrajectoryLayout& layout)
      : plan_(layout.plan), places_(static_cast<int>(layout.unit)), unit_(layout.unit) {
    for (int place = places_; place < 9; ++place) factor_ *= 10;
    matrix_ = !plan_.has(column::quaternion, 4);
  }

  /// Reads a row. Returns a BadRow if something is wrong with it.
  [[nodiscard]] std::optional<BadRow> read(std::string_view line, std::size_t number) {
    if (!read_plain(line)) {
      if (auto bad = read_fields(line, number)) return bad;
    }
    return matrix_ ? read_matrix(number) : read_quaternion(number);
  }

  [[nodiscard]] std::chrono::nanoseconds time() const { return time_; }
  [[nodiscard]] Eigen::Vector3d vector(std::size_t first) const {
    return {values_[first], values_[first + 1], values_[first + 2]};
  }
  /// R_WB, unit to within QuaternionTrack::norm_tolerance.
  [[nodiscard]] const Eigen::Quaterniond& attitude() const { return attitude_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t'; }

  /// Reads a well-formed row in one pass. Returns false for any other, which is then read field by field.
  [[nodiscard]] bool read_plain(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    const bool commas = line.find(',') != std::string_view::npos;
    const auto separates = [commas](char c) { return commas ? c == ',' : is_blank(c); };
    for (std::size_t i = 0; i < plan_.places.size(); ++i) {
      if (i > 0) {
        const char* const before = at;
        while (at != end && is_blank(*at)) ++at;
        if (commas) {
          if (at == end || *at++ != ',') return false;
          while (at != end && is_blank(*at)) ++at;
        } else if (at == before) {
          return false;
        }
      }
      const std::size_t place = plan_.places[i];
      if (place == column::ignored || place == column::time) {
        const char* const begin = at;
        while (at != end && !separates(*at)) ++at;
        if (place == column::time && !read_time({begin, static_cast<std::size_t>(at - begin)})) return false;
        continue;
      }
      if (!begins_as_real(at, end)) return false;
      const auto [behind, error] = real_from_chars(at, end, values_[place]);
      if (error != std::errc{}) return false;
      at = behind;
    }
    return at == end || (plan_.more && separates(*at)) || (*at == ',' && at + 1 == end);
  }

  [[nodiscard]] bool read_time(std::string_view text) {
    std::int64_t count = 0;
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data(), end, count);
    if (error == std::errc{} && behind == end) {
      constexpr std::int64_t most = (std::numeric_limits<std::int64_t>::max)();
      if (count > most / factor_ || count < -(most / factor_)) return false;
      time_ = std::chrono::nanoseconds{count * factor_};
      return true;
    }
    const auto parsed = parse_time(text, places_);
    time_ = parsed.value;
    return parsed.problem == nullptr;
  }

  [[nodiscard]] std::optional<BadRow> read_fields(std::string_view line, std::size_t number) {
    const auto fields = row_fields(line);
    const std::size_t planned = plan_.places.size();
    if (fields.size() < planned || (fields.size() > planned && !plan_.more)) {
      return BadRow{number, RowFault::malformed,
                    message(fields.size(), fields.size() == 1 ? " column" : " columns", ", expected ", planned,
                            plan_.more ? " or more: " : ": ", plan_.text())};
    }
    for (std::size_t i = 0; i < planned; ++i) {
      const std::size_t place = plan_.places[i];
      if (place == column::ignored) continue;
      const char* problem = nullptr;
      if (place == column::time) {
        const auto parsed = parse_time(fields[i], places_);
        time_ = parsed.value;
        problem = parsed.problem;
      } else {
        const Parsed<double> parsed = parse_real(fields[i]);
        values_[place] = parsed.value;
        problem = parsed.problem;
      }
      if (!problem) continue;
      const bool lost = is_lost_number(fields[i]);
      return BadRow{
          number, lost ? RowFault::not_finite : RowFault::malformed,
          message(excerpt(fields[i]), ' ', problem, ", expected ", trajectory_column_names[place],
                  place == column::time ? message(" [", time_unit_name(unit_), "]") : "", " in column ", i + 1)};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<BadRow> read_quaternion(std::size_t number) {
    const double* const xyzw = values_.data() + column::quaternion;
    attitude_ = Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    if (QuaternionTrack::is_unit(attitude_)) return std::nullopt;
    return BadRow{number, RowFault::not_unit, QuaternionTrack::problem_of(attitude_)};
  }

  [[nodiscard]] std::optional<BadRow> read_matrix(std::size_t number) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(values_.data() + column::matrix);
    const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off <= 2 * QuaternionTrack::norm_tolerance) || R.determinant() < 0) {
      return BadRow{number, RowFault::not_unit,
                    message("r11 … r33 are not a rotation: R^T R differs from I by ", off, ", the determinant is ",
                            R.determinant())};
    }
    attitude_ = Eigen::Quaterniond(Eigen::Matrix3d(R)).normalized();
    return std::nullopt;
  }

  ColumnPlan plan_;
  int places_;
  TimeUnit unit_;
  std::int64_t factor_ = 1;  // ns per unit
  bool matrix_ = false;
  std::array<double, trajectory_column_names.size()> values_{};
  std::chrono::nanoseconds time_{};
  Eigen::Quaterniond attitude_ = Eigen::Quaterniond::Identity();
};

}  // namespace splinertia::detail
