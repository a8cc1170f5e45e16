// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <splinertia/detail/message.hpp>
#include <stdexcept>
#include <string>
#include <system_error>

namespace splinertia::detail {

/// A file to read, directly into the caller's memory.
class InputFile {
 public:
  /// Opens it. Throws std::runtime_error with path and reason if it is missing, unreadable or a directory.
  explicit InputFile(const std::filesystem::path& path) : path_(path.string()) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
      throw std::runtime_error(message(path_, ": is a directory, expected a file"));
    }
    errno = 0;
    file_.reset(std::fopen(path_.c_str(), "rb"));
    if (!file_) throw std::runtime_error(message(path_, ": cannot open: ", std::generic_category().message(errno)));
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    if (std::filesystem::is_regular_file(path, error)) size_ = std::filesystem::file_size(path, error);
    if (error) size_ = 0;
  }

  /// Reads the next bytes and returns how many; fewer than `size` only at the end of the file or if it failed().
  [[nodiscard]] std::size_t read(char* to, std::size_t size) { return std::fread(to, 1, size, file_.get()); }

  /// Whether the system failed to read.
  [[nodiscard]] bool failed() const { return std::ferror(file_.get()) != 0; }

  /// The number of bytes when it was opened; 0 if that is not known (a pipe).
  [[nodiscard]] std::uintmax_t size() const { return size_; }

  /// Its name, for messages.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uintmax_t size_ = 0;
};

}  // namespace splinertia::detail
