// SPDX-License-Identifier: MIT
/// Reads text line by line; every error message names file and line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/detail/input_file.hpp>
#include <splinertia/io/detail/short_decimal.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinertia {

namespace detail {

/// The text without blanks (space, tab) at either end.
[[nodiscard]] inline std::string_view trim(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace detail

/// Splits a line at its commas, or at its runs of blanks if it has no comma. The fields are views of the line. Between
/// two adjacent commas is an empty field.
inline void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  const bool commas = line.find(',') != std::string_view::npos;
  const auto separates = [commas](char c) { return commas ? c == ',' : c == ' ' || c == '\t'; };
  line = detail::trim(line);
  while (!line.empty() || commas) {
    const auto end = static_cast<std::size_t>(std::find_if(line.begin(), line.end(), separates) - line.begin());
    fields.push_back(detail::trim(line.substr(0, end)));
    if (end == line.size()) return;
    line.remove_prefix(end + 1);
    if (!commas) line = detail::trim(line);
  }
}

/// A piece of a file for use in a message: in quotation marks, on one line, cut to `longest` bytes.
[[nodiscard]] inline std::string excerpt(std::string_view text, std::size_t longest = 40) {
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) result += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return result += text.size() > longest ? "…\"" : "\"";
}

/// The lines of a text file that hold data. Blank lines, lines that begin with #, a UTF-8 byte order mark and the
/// carriage returns of Windows are skipped.
///
///   TextFile file(path);
///   while (file.next()) parse(file.line());
///
/// It reads by blocks. Lines of a pipe are therefore available when a block is full or the pipe is closed. Memory: a
/// block, or twice the longest line.
class TextFile {
 public:
  /// Opens the file. Throws std::runtime_error if it is missing, unreadable or a directory.
  explicit TextFile(const std::filesystem::path& path) : file_(path) {}

  /// Goes to the next line of data; false at the end of the file. Throws std::runtime_error if reading fails.
  [[nodiscard]] bool next() {
    while (next_or_comment()) {
      if (line_.front() != '#') return true;
    }
    return false;
  }

  /// Reads the next line directly if it is a plain number and nothing else, without a search for its end. Returns false
  /// if it is anything else or not yet completely in memory; then call next(). Does not change line().
  [[nodiscard]] bool next_number(double& number) {
#if defined(__SIZEOF_INT128__)
    const char* const end = detail::short_decimal(begin_, end_, number);
    if (end == nullptr || end == end_ || *end != '\n') return false;
    begin_ = end + 1;
    ++number_;
    return true;
#else
    return false;
#endif
  }

  /// The same as next(), but stops at comments, too.
  [[nodiscard]] bool next_or_comment() {
    while (next_line()) {
      if (++number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.remove_prefix(3);
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      line_ = detail::trim(line_);
      if (!line_.empty()) return true;
    }
    return false;
  }

  /// The line of data, without blanks at its ends. Valid until next() is called.
  [[nodiscard]] std::string_view line() const { return line_; }

  /// Its number in the file, from 1.
  [[nodiscard]] std::size_t line_number() const { return number_; }

  /// The share of the file that was read, 0 to 1, for progress bars and estimates of the number of rows; 0 if the size
  /// is not known (a pipe).
  [[nodiscard]] double progress() const {
    const std::uintmax_t behind = read_ - static_cast<std::uintmax_t>(end_ - begin_);
    if (file_.size() == 0) return 0;
    return (std::min)(1.0, static_cast<double>(behind) / static_cast<double>(file_.size()));
  }

  /// The name of the file, for messages.
  [[nodiscard]] const std::string& path() const { return file_.path(); }

  /// Throws std::runtime_error "path:line: …" with the parts joined; before the first line, "path: …".
  template <typename... Parts>
  [[noreturn]] void fail(const Parts&... what) const {
    throw std::runtime_error(number_ == 0 ? detail::message(file_.path(), ": ", what...)
                                          : detail::message(file_.path(), ':', number_, ": ", what...));
  }

 private:
  /// Goes to the next line, without its '\n'. Text behind the last '\n' is a line unless it is empty.
  [[nodiscard]] bool next_line() {
    for (std::size_t searched = 0;;) {
      const auto left = static_cast<std::size_t>(end_ - begin_);
      if (left > searched) {
        if (const void* found = std::memchr(begin_ + searched, '\n', left - searched)) {
          const char* const newline = static_cast<const char*>(found);
          line_ = {begin_, static_cast<std::size_t>(newline - begin_)};
          begin_ = newline + 1;
          return true;
        }
      }
      searched = left;
      if (!read_on()) break;
    }
    line_ = {begin_, static_cast<std::size_t>(end_ - begin_)};
    begin_ = end_;
    return !line_.empty();
  }

  /// Appends the next bytes of the file to the piece of a line that is left in the buffer; false at the end.
  [[nodiscard]] bool read_on() {
    const auto left = static_cast<std::size_t>(end_ - begin_);
    if (2 * left > buffer_.size() || buffer_.empty()) {
      std::vector<char> larger((std::max)(block, 2 * buffer_.size()));
      std::copy(begin_, end_, larger.begin());
      buffer_ = std::move(larger);
    } else {
      std::copy(begin_, end_, buffer_.begin());  // to the left
    }
    const std::size_t added = file_.read(buffer_.data() + left, buffer_.size() - left);
    begin_ = buffer_.data();
    end_ = begin_ + left + added;
    read_ += added;
    if (file_.failed()) fail("cannot read on after this line");
    return added > 0;
  }

  static constexpr std::size_t block = 1 << 16;

  detail::InputFile file_;
  std::uintmax_t read_ = 0;  // bytes so far
  std::vector<char> buffer_;
  const char *begin_ = nullptr, *end_ = nullptr;  // the unread part of the buffer
  std::string_view line_;
  std::size_t number_ = 0;
};

}  // namespace splinertia
