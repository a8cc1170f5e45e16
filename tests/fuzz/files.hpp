// SPDX-License-Identifier: MIT
/// Files for fuzz targets: what readers are given, and what writers have written.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "fuzz/fuzz.hpp"
#include "io/temporary_directory.hpp"

namespace splinertia::fuzz {

/// A folder of this process, in memory where the system has that.
[[nodiscard]] inline const test::TemporaryDirectory& folder() {
  static const test::TemporaryDirectory folder([] {
    std::error_code error;
    const std::filesystem::path memory = "/dev/shm";
    const bool usable = std::filesystem::is_directory(memory, error) && ::access(memory.c_str(), W_OK) == 0;
    return usable ? memory : std::filesystem::temp_directory_path();
  }());
  return folder;
}

/// A file with contents that change, for a reader. Overwritten in place: five times as fast as making one each time.
class InputBytes {
 public:
  explicit InputBytes(const char* name) : path_((folder() / name).string()) {
    file_ = ::open(path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    if (file_ < 0) throw std::runtime_error(path_ + ": cannot create");
  }
  InputBytes(const InputBytes&) = delete;
  InputBytes& operator=(const InputBytes&) = delete;
  ~InputBytes() { ::close(file_); }

  /// Its path, with these contents.
  [[nodiscard]] const std::string& with(std::string_view contents) {
    const auto size = static_cast<off_t>(contents.size());
    if (::ftruncate(file_, size) != 0 || ::pwrite(file_, contents.data(), contents.size(), 0) != size) {
      throw std::runtime_error(path_ + ": cannot write");
    }
    return path_;
  }

 private:
  std::string path_;
  int file_;
};

/// The path of a file to write.
[[nodiscard]] inline std::string output_path() { return (folder() / "output").string(); }

}  // namespace splinertia::fuzz
