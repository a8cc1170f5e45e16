// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cassert>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/detail/file_stamps.hpp>
#include <splinertia/io/file_set.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/io/table_layout.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string_view>

namespace splinertia {

/// Writes a table row by row, in constant memory. The file appears with commit(). Members throw std::runtime_error if
/// the file cannot be written, and std::invalid_argument for what StampedTable would refuse: NaN, infinity, times that
/// do not increase, no rows.
class StampedTableWriter {
 public:
  StampedTableWriter(const std::filesystem::path& path, const TableLayout& layout) : file_(path), layout_(layout) {
    if (!layout.header) return;
    file_.append('#');
    file_.append(layout.names());
    file_.append('\n');
  }

  /// One row: a time, to the nearest nanosecond, and vectors whose elements together fill the other columns.
  template <TimePoint Time, typename... Vector>
  void append(Time row_time, const Vector&... values) {
    assert(static_cast<std::size_t>((1 + ... + values.size())) == layout_.columns.size());
    const std::chrono::nanoseconds time = stamps_.next(file_, row_time);
    char* end = file_.room(static_cast<std::size_t>((1 + ... + values.size())) * (number_text_size + 1));
    end = layout_.stamp == TableLayout::Stamp::seconds ? detail::seconds_to_chars(end, time)
                                                       : detail::integer_to_chars(end, time.count());
    ((end = write_values(end, values)), ...);
    *end++ = '\n';
    file_.advance(end);
  }

  /// Writes a line that readers skip: `# ` and the text. Requires a text without line breaks.
  void comment(std::string_view text) {
    assert(text.find_first_of("\n\r") == text.npos);
    file_.append("# ");
    file_.append(text);
    file_.append('\n');
  }

  /// Completes the file. It appears now, or together with the others of a set.
  void commit(std::same_as<FileSet> auto&... set) {
    if (stamps_.empty()) throw std::invalid_argument(detail::message(file_.path().string(), ": no rows to write"));
    file_.commit(set...);
  }

 private:
  [[nodiscard]] char* write_values(char* to, const auto& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const double value = values[i];
      if (!detail::is_finite(value)) file_.refuse(value);
      *to++ = layout_.separator;
      to = real_to_chars(to, value);
    }
    return to;
  }

  AtomicFile file_;
  TableLayout layout_;
  detail::FileStamps stamps_;
};

}  // namespace splinertia
