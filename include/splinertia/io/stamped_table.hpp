// SPDX-License-Identifier: MIT
/// Reads tables whose rows are a time and some numbers, such as TUM and EuRoC files.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/io/table_layout.hpp>
#include <splinertia/io/text_file.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace splinertia {

/// Reads the rows of a table one after the other. For the first deviation from the layout it throws std::runtime_error
/// with file:line, the value and what was expected: too few or too many columns, a number that is malformed or not
/// finite, a time that is not later than the one before, a file without rows.
///
///   StampedTable table(path, layout);
///   while (table.next()) use(table.time(), table[1], table.vector(2));
class StampedTable {
 public:
  StampedTable(const std::filesystem::path& path, const TableLayout& layout) : file_(path), layout_(layout) {}

  /// Goes to the next row; false at the end of the file.
  [[nodiscard]] bool next() {
    if (!file_.next()) {
      if (!time_) file_.fail("no rows, expected ", layout_.format, ": ", layout_.names());
      return false;
    }
    if (read_plain_row()) return true;
    split_fields(file_.line(), fields_);
    check_columns();
    check_time();
    values_.resize(fields_.size());
    for (std::size_t i = 1; i < fields_.size(); ++i) values_[i] = value_of(parse_real(fields_[i]), i);
    return true;
  }

  [[nodiscard]] std::chrono::nanoseconds time() const { return *time_; }

  /// The number in a column; the first after the time has index 1.
  [[nodiscard]] double operator[](std::size_t column) const {
    assert(column > 0 && column < values_.size());
    return values_[column];
  }

  /// The numbers in a column and the two to its right.
  [[nodiscard]] Eigen::Vector3d vector(std::size_t column) const {
    return {(*this)[column], (*this)[column + 1], (*this)[column + 2]};
  }

  /// Throws std::runtime_error "path:line: …" about the current row.
  template <typename... Parts>
  [[noreturn]] void fail(const Parts&... what) const {
    file_.fail(what...);
  }

  /// The estimated number of rows in the file, from the part that was read; 0 if its size is not known.
  [[nodiscard]] std::size_t expected_rows(std::size_t rows_so_far) const {
    const double progress = file_.progress();
    return progress > 0 ? static_cast<std::size_t>(static_cast<double>(rows_so_far) / progress) : 0;
  }

 private:
  /// Reads a row in one pass if it has the form that writers use: as many columns as the rows before, one character
  /// between them and no other blanks. Returns false for any other, good or bad, which is then read field by field.
  [[nodiscard]] bool read_plain_row() {
    if (!time_) return false;
    const char* at = file_.line().data();
    const char* const end = at + file_.line().size();
    std::chrono::nanoseconds time{};
    const std::string_view stamp = read_plain_stamp(at, end, time);
    if (stamp.empty() || time <= *time_) return false;
    const char separator = at != end ? *at : layout_.separator;
    if (separator != layout_.separator && separator != ' ') return false;
    for (std::size_t i = 1; i < values_.size(); ++i) {
      if (at == end || *at != separator || !detail::begins_as_real(++at, end)) return false;
      const auto [behind, error] = detail::real_from_chars(at, end, values_[i]);
      if (error != std::errc{}) return false;
      at = behind;
    }
    if (at != end) return false;
    time_ = time;
    stamp_ = stamp;
    return true;
  }

  /// Reads the time at the beginning of a row, moves `at` behind it, and returns its text; "" if it is malformed.
  [[nodiscard]] std::string_view read_plain_stamp(const char*& at, const char* end, std::chrono::nanoseconds& time) {
    const char* const begin = at;
    if (layout_.stamp == TableLayout::Stamp::nanoseconds) {
      std::int64_t count = 0;
      const auto [behind, error] = std::from_chars(begin, end, count);
      if (error != std::errc{}) return {};
      at = behind;
      time = std::chrono::nanoseconds{count};
    } else {
      while (at != end && *at != ',' && *at != ' ' && *at != '\t') ++at;
      const auto parsed = detail::parse_seconds({begin, static_cast<std::size_t>(at - begin)});
      if (parsed.problem) return {};
      time = parsed.value;
    }
    return {begin, static_cast<std::size_t>(at - begin)};
  }

  template <typename T>
  [[nodiscard]] T value_of(const Parsed<T>& parsed, std::size_t i) const {
    if (parsed.problem) {
      fail(excerpt(fields_[i]), ' ', parsed.problem, ", expected ", layout_.columns[i], " in column ", i + 1);
    }
    return parsed.value;
  }

  void check_columns() const {
    const std::size_t most = layout_.columns.size(), fewest = layout_.fewest_columns, count = fields_.size();
    if (layout_.separator == ' ' && file_.line().find(',') != std::string_view::npos) {
      fail(excerpt(file_.line()), " has commas, expected ", layout_.format, " separated by blanks: ", layout_.names());
    }
    if (count != most && count != fewest) {
      const std::string expected = fewest == most ? detail::message(most) : detail::message(fewest, " or ", most);
      fail(count, count == 1 ? " column" : " columns", ", expected ", expected, " of ", layout_.format, ": ",
           layout_.names());
    }
    if (time_ && count != values_.size()) fail(count, " columns, expected ", values_.size(), " as in the rows before");
  }

  void check_time() {
    const bool seconds = layout_.stamp == TableLayout::Stamp::seconds;
    std::chrono::nanoseconds time{};
    if (seconds) {
      time = value_of(detail::parse_seconds(fields_[0]), 0);
    } else {
      time = std::chrono::nanoseconds{value_of(parse_integer(fields_[0]), 0)};
    }
    if (time_ && time <= *time_) {
      fail("time ", fields_[0], " follows ", stamp_, ", expected increasing ", layout_.columns[0]);
    }
    time_ = time;
    stamp_ = fields_[0];
  }

  TextFile file_;
  TableLayout layout_;
  std::vector<std::string_view> fields_;
  std::vector<double> values_;  // by column; the first is unused
  std::optional<std::chrono::nanoseconds> time_;
  std::string stamp_;  // text of time_ in the file
};

/// All rows of a table, each converted by `parse(const StampedTable&)`. Throws as StampedTable does.
template <typename Parse>
[[nodiscard]] auto read_stamped_table(const std::filesystem::path& path, const TableLayout& layout, Parse parse) {
  std::vector<decltype(parse(std::declval<const StampedTable&>()))> rows;
  StampedTable table(path, layout);
  while (table.next()) {
    if (rows.size() == rows.capacity() && rows.size() >= 256) {  // enough to estimate the rest
      const std::size_t expected = table.expected_rows(rows.size());
      rows.reserve((std::max)(expected + expected / 64, 2 * rows.size()));
    }
    rows.push_back(parse(std::as_const(table)));
  }
  return rows;
}

}  // namespace splinertia
