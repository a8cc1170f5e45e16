// SPDX-License-Identifier: MIT
/// Writing a file that is there complete or not at all.
#pragma once

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <splinertia/finite.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/message.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace splinertia {

/// Writes to a temporary file beside the target and renames it on commit(). Until then, and for ever if an exception
/// comes in between, the target is as it was; the destructor removes what was not committed. Only a power failure
/// within seconds of commit() can still lose the file, because nothing is forced to the disk.
///
///   AtomicFile file("out.txt");
///   file.append_real(0.1);
///   file.append('\n');
///   file.commit();
///
/// Numbers are formatted straight into one buffer and read back to the same bits. Every member throws
/// std::runtime_error with path and reason when the system refuses: no such folder, disk full, …
class AtomicFile {
 public:
  /// Creates the temporary file. A symbolic link is followed. Refuses targets that are no regular files (/dev/stdout).
  explicit AtomicFile(const std::filesystem::path& path) : target_(path) {
    std::error_code error;
    if (std::filesystem::is_symlink(path, error)) {
      if (auto linked = std::filesystem::canonical(path, error); !error) target_ = std::move(linked);
    }
    if (std::filesystem::exists(target_, error) && !std::filesystem::is_regular_file(target_, error)) {
      throw std::runtime_error(message(target_.string(), ": exists and is not a regular file"));
    }
    std::random_device random;
    do {
      temporary_ = target_;
      temporary_ += message(".", random(), ".tmp");
      errno = 0;
      file_ = std::fopen(temporary_.string().c_str(), "wbx");
    } while (!file_ && errno == EEXIST);
    if (!file_) fail("cannot create a file beside it");
    std::setvbuf(file_, nullptr, _IONBF, 0);  // the buffer is ours
  }

  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  ~AtomicFile() { abandon(); }

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
  void append_integer(std::int64_t value) { advance(integer_to_chars(room(number_text_size), value)); }
  /// Throws std::invalid_argument for NaN and infinity, which no reader would take.
  void append_real(double value) {
    if (!is_finite(value)) refuse(value);
    advance(real_to_chars(room(number_text_size), value));
  }
  /// Seconds with nine decimals, exactly.
  void append_seconds(std::chrono::nanoseconds time) { advance(seconds_to_chars(room(number_text_size), time)); }

  /// Room for `size` characters at the end of the file, to be written by the caller, who then says with advance() where
  /// they end. Valid until the next call of any other member.
  [[nodiscard]] char* room(std::size_t size) {
    reserve(size);
    return end_;
  }
  void advance(char* end) { end_ = end; }

  /// Gives up and throws what append_real throws for a number that is not finite.
  [[noreturn]] void refuse(double value) {
    char text[number_text_size];
    const std::string_view name(text, static_cast<std::size_t>(real_to_chars(text, value) - text));
    abandon();
    throw std::invalid_argument(message(target_.string(), ": cannot write ", name, ", expected a finite number"));
  }

  /// Replaces the beginning of the file, at least as long, by a text of its size.
  void overwrite_begin(std::string_view text) {
    flush();
    errno = 0;
    if (std::fseek(file_, 0, SEEK_SET) != 0 || std::fwrite(text.data(), 1, text.size(), file_) != text.size() ||
        std::fseek(file_, 0, SEEK_END) != 0) {
      fail("cannot write");
    }
  }

  /// Writes what is buffered and puts the file in the target's place. Nothing can be appended afterwards.
  void commit() {
    flush();
    errno = 0;
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail("cannot write");
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) fail("cannot put the new file in place", error);
    temporary_.clear();
  }

  /// Gives up: removes the temporary file. From then on, as after any error, whatever is appended or committed throws.
  void abandon() noexcept {
    if (file_) std::fclose(std::exchange(file_, nullptr));
    std::error_code ignored;
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
    temporary_.clear();
  }

  /// The file that commit() writes.
  [[nodiscard]] const std::filesystem::path& path() const { return target_; }

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
    if (!file_) throw std::runtime_error(message(target_.string(), ": was committed or abandoned before"));
    const std::size_t size = static_cast<std::size_t>(end_ - buffer_.get());
    end_ = buffer_.get();
    errno = 0;
    if (std::fwrite(end_, 1, size, file_) != size) fail("cannot write");
  }
  [[noreturn]] void fail(std::string_view what, std::error_code error = {errno, std::generic_category()}) {
    abandon();
    throw std::runtime_error(message(target_.string(), ": ", what, ": ", error.message()));
  }

  std::filesystem::path target_, temporary_;
  std::FILE* file_ = nullptr;
  std::size_t capacity_ = 1 << 16;
  std::unique_ptr<char[]> buffer_{new char[capacity_]};
  char* end_ = buffer_.get();
};

}  // namespace splinertia
