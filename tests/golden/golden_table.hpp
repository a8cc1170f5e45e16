// SPDX-License-Identifier: MIT
/// Reads the tables of reference values (README.md): a header line, cells separated by ',', the numbers of a cell by
/// one blank; an empty cell is not applicable.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace golden {

[[nodiscard]] inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// A table in memory. Errors name the file, and the line where there is one.
class Table {
 public:
  /// One line of the table.
  class Row {
   public:
    [[nodiscard]] const Table& table() const { return *table_; }
    [[nodiscard]] bool has(std::string_view column) const { return table_->has(column); }
    [[nodiscard]] const std::string& text(std::string_view column) const {
      return table_->cells_[index_][table_->column(column)];
    }
    /// Whether the cell is "1"; no such column is false.
    [[nodiscard]] bool flag(std::string_view column) const { return has(column) && text(column) == "1"; }
    [[nodiscard]] int integer(std::string_view column) const { return static_cast<int>(integer64(column)); }
    [[nodiscard]] std::int64_t integer64(std::string_view column) const {
      return number<std::int64_t>(column, text(column),
                                  [](const char* s, char** end) -> std::int64_t { return std::strtoll(s, end, 10); });
    }
    /// An input: read as the double that the truth was computed from, and only then converted.
    template <typename Scalar>
    [[nodiscard]] Scalar input(std::string_view column) const {
      return static_cast<Scalar>(number<double>(column, text(column), std::strtod));
    }
    template <typename Scalar>
    [[nodiscard]] std::vector<Scalar> inputs(std::string_view column) const {
      std::vector<Scalar> values;
      for (const double x : numbers<double>(column, std::strtod)) values.push_back(static_cast<Scalar>(x));
      return values;
    }
    /// Outputs: as many of the 25 digits as long double keeps.
    [[nodiscard]] std::vector<long double> outputs(std::string_view column) const {
      return numbers<long double>(column, std::strtold);
    }

   private:
    friend class Table;
    Row(const Table& table, std::size_t index) : table_(&table), index_(index) {}

    template <typename Real, typename Parse>
    [[nodiscard]] std::vector<Real> numbers(std::string_view column, Parse parse) const {
      std::vector<Real> values;
      const std::string& cell = text(column);
      if (cell.empty()) return values;
      for (const std::string& part : split(cell, ' ')) values.push_back(number<Real>(column, part, parse));
      return values;
    }
    template <typename Real, typename Parse>
    [[nodiscard]] Real number(std::string_view column, const std::string& text, Parse parse) const {
      char* end = nullptr;
      const Real value = parse(text.c_str(), &end);
      if (text.empty() || *end != '\0') {
        throw std::runtime_error(table_->where(index_) + "column " + std::string(column) + ": '" + text +
                                 "' is not a number");
      }
      return value;
    }

    const Table* table_;
    std::size_t index_;
  };

  /// Throws std::runtime_error for a file that is not there or not such a table.
  explicit Table(const std::filesystem::path& path) : path_(path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path.string() + ": cannot be read");
    std::string line;
    while (std::getline(file, line)) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      auto cells = split(line, ',');
      if (columns_.empty()) {
        columns_ = std::move(cells);
      } else if (cells.size() == columns_.size()) {
        cells_.push_back(std::move(cells));
      } else {
        throw std::runtime_error(where(cells_.size()) + std::to_string(cells.size()) + " cells where the header has " +
                                 std::to_string(columns_.size()));
      }
    }
    if (columns_.empty()) throw std::runtime_error(path.string() + ": empty");
  }

  [[nodiscard]] std::string name() const { return path_.stem().string(); }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] Row operator[](std::size_t index) const { return {*this, index}; }
  [[nodiscard]] bool has(std::string_view column) const { return find(column) != columns_.size(); }

 private:
  [[nodiscard]] std::size_t find(std::string_view column) const {
    std::size_t i = 0;
    while (i < columns_.size() && columns_[i] != column) ++i;
    return i;
  }
  [[nodiscard]] std::size_t column(std::string_view name) const {
    const auto i = find(name);
    if (i == columns_.size()) throw std::runtime_error(path_.string() + ": no column " + std::string(name));
    return i;
  }
  /// "file:line: " of a row; the header is line 1.
  [[nodiscard]] std::string where(std::size_t row) const {
    return path_.string() + ":" + std::to_string(row + 2) + ": ";
  }

  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> cells_;
};

using Row = Table::Row;

}  // namespace golden
