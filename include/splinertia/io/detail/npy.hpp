// SPDX-License-Identifier: MIT
/// NumPy's .npy files, format 1.0, with one-dimensional arrays of records: a header, then the records one after the
/// other. https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/detail/input_file.hpp>
#include <splinertia/io/file_set.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinertia::detail {

/// The beginning of a file: magic and version 1.0. Two bytes with the length of the rest of the header follow.
inline constexpr std::string_view npy_magic{"\x93NUMPY\x01\x00", 8};
inline constexpr std::size_t npy_preamble = npy_magic.size() + 2;

/// The bytes before the records. Their number does not depend on `rows`, so that the header can be overwritten when all
/// rows are counted.
[[nodiscard]] inline std::string npy_header(std::string_view dtype, std::uint64_t rows) {
  constexpr std::size_t alignment = 64, longest_shape = std::numeric_limits<std::uint64_t>::digits10 + 1;
  std::string dict = message("{'descr': ", dtype, ", 'fortran_order': False, 'shape': (");
  const std::size_t least = npy_preamble + dict.size() + longest_shape + std::string_view(",), }\n").size();
  const std::size_t size = (least + alignment - 1) / alignment * alignment;
  dict += message(rows, ",), }");
  dict.resize(size - npy_preamble - 1, ' ');
  dict += '\n';
  assert(dict.size() <= (std::numeric_limits<std::uint16_t>::max)());
  std::string header(npy_magic);
  header += static_cast<char>(static_cast<unsigned char>(dict.size() % 256));
  header += static_cast<char>(static_cast<unsigned char>(dict.size() / 256));
  return header + dict;
}

/// A Python literal in a normal form that does not depend on the writer: no blanks between its parts, single quotation
/// marks, no comma before ] or }.
[[nodiscard]] inline std::string plain_literal(std::string_view literal) {
  std::string plain;
  char quote = 0;
  for (const char c : literal) {
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\n' || c == '\r')) continue;
    if (quote == 0 && (c == '}' || c == ']') && plain.ends_with(',')) plain.pop_back();
    if (quote == 0 ? c == '\'' || c == '"' : c == quote) {
      quote = quote == 0 ? c : char{0};
      plain += '\'';
    } else {
      plain += c;
    }
  }
  return plain;
}

/// The value of a key in the plain_literal() of a dict, "" if it is not there.
[[nodiscard]] inline std::string_view dict_entry(std::string_view dict, std::string_view key) {
  if (!dict.starts_with('{')) return {};
  int depth = 0;
  bool quoted = false;
  std::size_t begin = 1;  // of an entry, behind { or ,
  for (std::size_t i = 0; i < dict.size(); ++i) {
    const char c = dict[i];
    if (c == '\'') quoted = !quoted;
    if (quoted) continue;
    if (c == '{' || c == '[' || c == '(') ++depth;
    if (c == '}' || c == ']' || c == ')') --depth;
    if ((depth != 1 || c != ',') && depth != 0) continue;
    const std::string_view entry = dict.substr(begin, i - begin);
    if (entry.size() > key.size() + 3 && entry.substr(1, key.size()) == key &&
        entry.substr(key.size() + 1, 2) == "':") {
      return entry.substr(key.size() + 3);
    }
    if (depth == 0) break;
    begin = i + 1;
  }
  return {};
}

/// Writes records one after the other, in constant memory. The file appears with commit(). Members throw
/// std::runtime_error if the file cannot be written.
class NpyWriter {
 public:
  /// `dtype` as NumPy writes it, such as "[('time_ns', '<i8'), ('value', '<f8')]".
  NpyWriter(const std::filesystem::path& path, std::string dtype) : file_(path), dtype_(std::move(dtype)) {
    file_.append(npy_header(dtype_, 0));
  }

  /// Room for a record. The caller writes it and then calls advance() with its end.
  [[nodiscard]] char* room(std::size_t size) { return file_.room(size); }
  void advance(char* end) {
    file_.advance(end);
    ++rows_;
  }

  /// Completes the file. It appears now, or together with the others of a set. Throws std::invalid_argument if there
  /// are no records.
  void commit(std::same_as<FileSet> auto&... set) {
    if (rows_ == 0) throw std::invalid_argument(message(file_.path().string(), ": no rows to write"));
    file_.overwrite_begin(npy_header(dtype_, rows_));
    file_.commit(set...);
  }

  /// For abandon().
  [[nodiscard]] AtomicFile& file() { return file_; }

 private:
  AtomicFile file_;
  std::string dtype_;
  std::uint64_t rows_ = 0;
};

/// Reads a file of records of one dtype. For the first error it throws std::runtime_error "path: byte …" or "path: row
/// …" (from 0, as NumPy counts) with what was found and expected: wrong magic, version, dtype, array order or shape, an
/// end too early or too late, no rows.
///
///   NpyReader file(path, dtype, size);
///   while (file.next()) use(file.record());
class NpyReader {
 public:
  NpyReader(const std::filesystem::path& path, std::string_view dtype, std::size_t record_size)
      : file_(path),
        record_size_(record_size),
        buffer_(std::max<std::size_t>(1, (1 << 16) / record_size) * record_size) {
    std::array<char, npy_preamble> preamble{};
    const std::string_view start(preamble.data(), file_.read(preamble.data(), preamble.size()));
    if (!start.starts_with(npy_magic.substr(0, 6))) {
      fail("byte 0: ", excerpt(start.substr(0, 6)), ", expected an .npy file, which begins with \\x93NUMPY");
    }
    if (start.size() >= npy_magic.size() && !start.starts_with(npy_magic)) {
      const auto version = [&](std::size_t i) { return static_cast<int>(static_cast<unsigned char>(start[i])); };
      fail("byte 6: version ", version(6), '.', version(7), " of the .npy format, expected 1.0");
    }
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(preamble[i])); };
    std::string dict(byte(8) + 256 * byte(9), '\0');
    const std::size_t read = start.size() == npy_preamble ? file_.read(dict.data(), dict.size()) : 0;
    offset_ = start.size() + read;
    if (start.size() < npy_preamble || read < dict.size()) fail_end("in the header");
    check(plain_literal(dict), dtype);
  }

  /// The number of rows by the header, but not more than the size of the file allows; 0 if its size is not known (a
  /// pipe).
  [[nodiscard]] std::size_t expected_rows() const {
    return static_cast<std::size_t>(std::min<std::uintmax_t>(rows_, file_.size() / record_size_));
  }

  /// Goes to the next record; false behind the last.
  [[nodiscard]] bool next() {
    if (row_ == rows_) {
      char byte = 0;
      if (file_.read(&byte, 1) > 0) {
        fail("byte ", offset_, ": more bytes after the last of ", rows_, " rows, expected the end of the file");
      }
      return false;
    }
    record_ = record_ + record_size_ < end_ ? record_ + record_size_ : read_on();
    ++row_;
    return true;
  }

  /// The bytes of the record. Valid until next() is called.
  [[nodiscard]] const char* record() const { return buffer_.data() + record_; }

  /// Throws std::runtime_error about the current row.
  template <typename... Parts>
  [[noreturn]] void fail_row(const Parts&... what) const {
    fail("row ", row_ - 1, ": ", what...);
  }

 private:
  template <typename... Parts>
  [[noreturn]] void fail(const Parts&... what) const {
    throw std::runtime_error(message(file_.path(), ": ", what...));
  }
  [[noreturn]] void fail_end(const std::string& where) const {
    if (file_.failed()) fail("byte ", offset_, ": cannot read on");
    fail("byte ", offset_, ": the file ends ", where);
  }

  void check(std::string_view dict, std::string_view dtype) {
    const auto expect = [&](bool good, std::string_view what, std::string_view found, std::string_view expected) {
      if (!good) fail("byte ", npy_preamble, ": ", what, " is ", excerpt(found, 200), ", expected ", expected);
    };
    std::size_t length = std::string_view("{,,}").size();
    const auto entry = [&](std::string_view key) {
      const std::string_view value = dict_entry(dict, key);
      length += key.size() + std::string_view("'':").size() + value.size();
      return value;
    };
    const std::string_view descr = entry("descr"), fortran_order = entry("fortran_order"), shape = entry("shape");
    const bool flat = shape.size() > 3 && shape.starts_with('(') && shape.ends_with(",)");
    const Parsed<std::int64_t> rows = parse_integer(flat ? shape.substr(1, shape.size() - 3) : "");
    expect(descr == plain_literal(dtype), "descr", descr, dtype);
    expect(fortran_order == "False", "fortran_order", fortran_order, "False");
    expect(!rows.problem && rows.value > 0, "shape", shape, "(rows,) with at least 1");
    expect(dict.size() == length, "the header", dict, "a dict of descr, fortran_order and shape");
    rows_ = static_cast<std::uint64_t>(rows.value);
  }

  /// Reads the next block of records and returns the position of its first one.
  [[nodiscard]] std::size_t read_on() {
    const std::uint64_t records = std::min<std::uint64_t>(rows_ - row_, buffer_.size() / record_size_);
    const std::size_t wanted = static_cast<std::size_t>(records) * record_size_;
    end_ = file_.read(buffer_.data(), wanted);
    offset_ += end_;
    if (end_ < wanted) fail_end(message("in row ", row_ + end_ / record_size_, ", expected ", rows_, " rows"));
    return 0;
  }

  InputFile file_;
  std::size_t record_size_;
  std::vector<char> buffer_;
  std::size_t record_ = 0, end_ = 0;  // in the buffer
  std::uint64_t rows_ = 0, row_ = 0;  // in the file; given by next() so far
  std::uint64_t offset_ = 0;          // bytes read
};

}  // namespace splinertia::detail
