// SPDX-License-Identifier: MIT
/// The beginning of a trajectory file, by which its format is recognised.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <splinertia/io/detail/trajectory_header.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// A copy of a line of a file.
struct NumberedLine {
  std::size_t number;
  std::string text;
};

/// The fields of a row, without an empty one behind a trailing separator.
[[nodiscard]] inline std::vector<std::string_view> row_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  split_fields(line, fields);
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

/// Whether a text is NaN or infinite.
[[nodiscard]] inline bool is_lost_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

/// The header and the first rows of a file. Rows are stored, since a pipe cannot be read twice.
class TrajectoryHead {
 public:
  static constexpr std::size_t most_rows = 100;

  /// Reads them. Throws std::runtime_error if there are no rows.
  explicit TrajectoryHead(TextFile& file) {
    bool first_line = true;
    while (rows.size() < most_rows && file.next_or_comment()) {
      const std::string_view line = file.line();
      if (line.front() == '#' || (first_line && has_no_number(line))) {
        if (line.front() != '#') first_line = false;
        if (rows.empty()) add_header(file);
        continue;
      }
      first_line = false;
      rows.push_back({file.line_number(), std::string(line)});
    }
    if (rows.empty()) file.fail("no rows, expected the poses of a trajectory");
    std::map<std::size_t, std::size_t> counts;
    for (const NumberedLine& row : rows) ++counts[row_fields(row.text).size()];
    for (const auto& [count, number] : counts) {  // if tied, the larger: rows more often lose than gain columns
      if (columns == 0 || number >= counts[columns]) columns = count;
    }
    for (const NumberedLine& row : rows) {
      if (row_fields(row.text).size() == columns) typical_rows.push_back(row_fields(row.text));
    }
    commas = rows.front().text.find(',') != std::string::npos;
    trailing_comma = rows.front().text.ends_with(',');
  }

  /// The texts in a column.
  [[nodiscard]] std::vector<std::string_view> texts(std::size_t column) const {
    std::vector<std::string_view> result;
    for (const auto& fields : typical_rows) result.push_back(fields[column]);
    return result;
  }

  /// Whether most rows have a unit quaternion in the four columns from `first` on.
  [[nodiscard]] bool has_unit_quaternion(std::size_t first) const {
    std::size_t unit = 0;
    for (const auto& fields : typical_rows) {
      double squares = 0;
      for (std::size_t i = first; i < first + 4 && i < fields.size(); ++i) {
        const double value = parse_real(fields[i]).value;
        squares += value * value;
      }
      if (squares > 0.998 && squares < 1.002) ++unit;
    }
    return 2 * unit > typical_rows.size();
  }

  std::vector<NumberedLine> rows;
  std::vector<std::vector<std::string_view>> typical_rows;  // fields of those with `columns` of them; they view `rows`
  std::size_t columns = 0;                                  // that most rows have
  bool commas = false, trailing_comma = false;              // of the first row
  std::optional<Header> header;                // the last line that names columns of poses, if there is one
  std::size_t header_line = 0;                 // where it stands
  std::optional<NumberedLine> unclear_header;  // a line without # or numbers that does not name columns of poses

 private:
  /// Whether no field begins like a number, is NaN or is infinite. Some fields may be empty, but not all.
  [[nodiscard]] static bool has_no_number(std::string_view line) {
    const auto fields = row_fields(line);
    const auto is_empty = [](std::string_view field) { return field.empty(); };
    return !std::all_of(fields.begin(), fields.end(), is_empty) &&
           std::none_of(fields.begin(), fields.end(), [](std::string_view field) {
             return (!field.empty() &&
                     std::string_view("+-.0123456789").find(field.front()) != std::string_view::npos) ||
                    is_lost_number(field);
           });
  }

  void add_header(const TextFile& file) {
    Header read = read_header(file.line());
    if (read.complete()) {
      header = std::move(read);
      header_line = file.line_number();
    } else if (file.line().front() != '#') {
      unclear_header = {file.line_number(), std::string(file.line())};
    }
  }
};

}  // namespace splinertia::detail
