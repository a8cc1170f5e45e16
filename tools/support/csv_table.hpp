// SPDX-License-Identifier: MIT
// Tables of comma-separated values.
#pragma once

#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "support/concat.hpp"

/// A cell for a real number that may be NaN, which is written as nan.
struct RealOrNan {
  double value;
};

/// Writes a table of comma-separated values to a file: a line of names, then rows.
///
///   AtomicFile file("errors.csv");
///   CsvTable table(file, {"#timestamp [ns]", "part", "error [m]"});
///   table.row(time, "position", 0.25);
///   file.commit();
class CsvTable {
 public:
  /// Writes the names of the columns. The file may already have comments.
  CsvTable(splinertia::AtomicFile& file, std::initializer_list<std::string_view> names)
      : file_(file), columns_(names.size()) {
    for (const std::string_view name : names) append(name);
    file_.append('\n');
  }

  /// Writes a row. A cell is a text, a character, an integer, a bool (1 or 0), a time (ns), a real number or RealOrNan;
  /// an empty optional is an empty cell. A vector or another range of these has a cell for each element. Texts are
  /// written unchanged: they need quotation marks where they have commas. Reals read back to the same bits. Throws
  /// std::invalid_argument for a real number that is not finite, std::logic_error for another number of cells than
  /// columns.
  template <typename... Cells>
  void row(const Cells&... cells) {
    column_ = 0;
    (append(cells), ...);
    if (column_ != columns_) throw std::logic_error(concat("a row of ", column_, " cells, expected ", columns_));
    file_.append('\n');
  }

 private:
  template <typename Cell>
  static constexpr bool is_text = std::convertible_to<const Cell&, std::string_view>;

  template <typename Cell>
  void append(const Cell& cell) {
    if constexpr (!is_text<Cell> && requires { cell.begin(); }) {
      for (const auto& element : cell) append(element);
    } else {
      if (column_++ > 0) file_.append(',');
      append_value(cell);
    }
  }

  template <typename Cell>
  void append_value(const Cell& cell) {
    if constexpr (is_text<Cell>) {
      file_.append(std::string_view(cell));
    } else if constexpr (std::is_same_v<Cell, char>) {
      file_.append(cell);
    } else if constexpr (std::integral<Cell>) {
      file_.append_integer(static_cast<std::int64_t>(cell));
    } else {
      static_assert(std::floating_point<Cell>, "a cell is a text, a character or a number");
      file_.append_real(cell);
    }
  }
  void append_value(std::chrono::nanoseconds time) { file_.append_integer(time.count()); }
  void append_value(RealOrNan number) {
    std::isnan(number.value) ? file_.append("nan") : file_.append_real(number.value);
  }
  template <typename Cell>
  void append_value(const std::optional<Cell>& cell) {
    if (cell) append_value(*cell);
  }

  splinertia::AtomicFile& file_;
  std::size_t columns_, column_ = 0;
};
