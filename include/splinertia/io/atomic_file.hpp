// SPDX-License-Identifier: MIT
/// Writes a file that either appears complete or not at all.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/detail/pending_file.hpp>
#include <splinertia/io/file_set.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace splinertia {

/// Writes a file that appears with commit(). If an exception or a signal comes first, the old file stays as it was and
/// nothing is left of the new one. (On systems without nameless files, a signal leaves `.splinertia.NUMBER.tmp`.) Only
/// a power failure within seconds of commit() can lose both, because nothing is forced to the disk.
///
///   AtomicFile file("out.txt");
///   file.append_real(0.1);
///   file.append('\n');
///   file.commit();
///
/// Numbers are formatted directly into one buffer and read back to the same bits. The file gets the permissions of the
/// one that it replaces. Other hard links to that one keep the old text. Every member throws WriteError, a
/// std::runtime_error, with path and reason if the system cannot write: disk full, …
class AtomicFile {
 public:
  /// Symbolic links are followed. Throws std::runtime_error if the path cannot be written: it is not a regular file
  /// (/dev/stdout), it is read-only, there is no such folder, …
  explicit AtomicFile(const std::filesystem::path& path) : file_(path) {}

  void append(char c) {
    reserve(1);
    *end_++ = c;
  }
  void append(std::string_view text) {
    while (!text.empty()) {
      reserve(1);
      const std::size_t copied = text.copy(end_, static_cast<std::size_t>(buffer_.get() + capacity_ - end_));
      end_ += copied;
      text.remove_prefix(copied);
    }
  }
  void append_integer(std::int64_t value) { advance(detail::integer_to_chars(room(number_text_size), value)); }
  /// Throws std::invalid_argument for NaN and infinity, which no reader would take.
  void append_real(double value) {
    if (!detail::is_finite(value)) refuse(value);
    advance(real_to_chars(room(number_text_size), value));
  }
  /// Seconds with nine decimals, exactly.
  void append_seconds(std::chrono::nanoseconds time) {
    advance(detail::seconds_to_chars(room(number_text_size), time));
  }

  /// Room for `size` characters at the end of the file. The caller writes them and then calls advance() with their end.
  /// Valid until the next call of any other member.
  [[nodiscard]] char* room(std::size_t size) {
    reserve(size);
    return end_;
  }
  void advance(char* end) { end_ = end; }

  /// Drops the file and throws what append_real throws for a number that is not finite.
  [[noreturn]] void refuse(double value) {
    char text[number_text_size];
    const std::string_view name(text, static_cast<std::size_t>(real_to_chars(text, value) - text));
    abandon();
    throw std::invalid_argument(
        detail::message(path().string(), ": cannot write ", name, ", expected a finite number"));
  }

  /// Overwrites the first text.size() characters of the file. Requires that the file is at least as long.
  void overwrite_begin(std::string_view text) {
    flush();
    file_.overwrite_begin(text);
  }

  /// Writes what is buffered and replaces the target by the file. Appending afterwards throws.
  void commit() {
    complete();
    file_.publish();
  }

  /// The same, but the file appears when the set is committed.
  void commit(FileSet& set) {
    complete();
    set.add(file_.release());
  }

  /// Drops the new file. Appending and committing then throw, as after any error.
  void abandon() noexcept {
    close();
    file_.discard();
  }

  /// The file that commit() writes.
  [[nodiscard]] const std::filesystem::path& path() const { return file_.target(); }

 private:
  void reserve(std::size_t size) {
    if (static_cast<std::size_t>(buffer_.get() + capacity_ - end_) >= size) return;
    flush();
    if (capacity_ >= size) return;
    buffer_.reset(new char[size]);
    end_ = buffer_.get();
    capacity_ = size;
  }
  void flush() {
    const std::string_view text(buffer_.get(), static_cast<std::size_t>(end_ - buffer_.get()));
    close();
    file_.write(text);
    end_ = buffer_.get();
  }
  void complete() {
    flush();
    close();
    file_.complete();
  }
  /// Marks the buffer as full, so that anything appended goes to file_ at once, which throws.
  void close() noexcept { end_ = buffer_.get() + capacity_; }

  detail::PendingFile file_;
  std::size_t capacity_ = 1 << 16;
  std::unique_ptr<char[]> buffer_{new char[capacity_]};
  char* end_ = buffer_.get();
};

}  // namespace splinertia
