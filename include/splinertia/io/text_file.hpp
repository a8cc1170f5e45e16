// SPDX-License-Identifier: MIT
/// Reading text line by line, such that every complaint names file and line.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <splinertia/message.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace splinertia {

/// The text without blanks (space, tab) at either end.
[[nodiscard]] inline std::string_view trim(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Splits a line at its commas, or at its runs of blanks if it has no comma. The fields view the line. Two commas in a
/// row have an empty field between them.
inline void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  const bool commas = line.find(',') != std::string_view::npos;
  const auto separates = [commas](char c) { return commas ? c == ',' : c == ' ' || c == '\t'; };
  line = trim(line);
  while (!line.empty() || commas) {
    const auto end = static_cast<std::size_t>(std::find_if(line.begin(), line.end(), separates) - line.begin());
    fields.push_back(trim(line.substr(0, end)));
    if (end == line.size()) return;
    line.remove_prefix(end + 1);
    if (!commas) line = trim(line);
  }
}

/// A piece of a file as it may stand in a message: in quotation marks, on one line, not long.
[[nodiscard]] inline std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) result += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return result += text.size() > longest ? "…\"" : "\"";
}

/// The lines of a text file that hold data: blank lines and lines that begin with # are passed over, as are a UTF-8
/// byte order mark and the carriage returns of Windows.
///
///   TextFile file(path);
///   while (file.next()) parse(file.line());
class TextFile {
 public:
  /// Opens the file. Throws std::runtime_error if it is missing, unreadable or a directory.
  explicit TextFile(const std::filesystem::path& path) : path_(path.string()) {
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) fail("is a directory, expected a file");
    errno = 0;
    stream_.open(path, std::ios::binary);
    if (!stream_) fail("cannot open: ", std::generic_category().message(errno));
  }

  /// Goes to the next line of data; false at the end of the file. Throws std::runtime_error if the file cannot be read
  /// on.
  [[nodiscard]] bool next() {
    while (std::getline(stream_, buffer_)) {
      line_ = buffer_;
      if (++number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.remove_prefix(3);
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      line_ = trim(line_);
      if (!line_.empty() && line_.front() != '#') return true;
    }
    if (stream_.bad()) fail("cannot read on after this line");
    return false;
  }

  /// The line of data, without blanks at its ends. Valid until next() is called.
  [[nodiscard]] std::string_view line() const { return line_; }

  /// Its number in the file, from 1.
  [[nodiscard]] std::size_t line_number() const { return number_; }

  /// Throws std::runtime_error "path:line: …" with the parts joined; without the line before the first.
  template <typename... Parts>
  [[noreturn]] void fail(const Parts&... what) const {
    throw std::runtime_error(number_ == 0 ? message(path_, ": ", what...)
                                          : message(path_, ':', number_, ": ", what...));
  }

 private:
  std::string path_, buffer_;
  std::ifstream stream_;
  std::string_view line_;
  std::size_t number_ = 0;
};

}  // namespace splinertia
