// SPDX-License-Identifier: MIT
/// A file that is not visible until it is complete.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <random>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/write_error.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#if __has_include(<unistd.h>)
#include <fcntl.h>
#include <unistd.h>
#endif

namespace splinertia::detail {

/// The path to which symbolic links lead; a file need not exist there. Requires that the links form no loop.
[[nodiscard]] inline std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code error;
  while (std::filesystem::is_symlink(path, error)) {
    path = path.parent_path() / std::filesystem::read_symlink(path);
  }
  return path;
}

/// A file without a name, if the system supports it (Linux: O_TMPFILE, on most local file systems): nothing of it is
/// left, however the program ends. Otherwise a hidden file `.splinertia.NUMBER.tmp` beside the target, which is left if
/// the program is killed.
class PendingFile {
 public:
  /// Creates it. Throws std::runtime_error if the target cannot be written: it is not a regular file, it is read-only,
  /// its name is too long, there is no such folder, …
  explicit PendingFile(const std::filesystem::path& path) : given_(path), target_(path) {
    std::error_code error;
    const auto old = std::filesystem::status(path, error);
    if (old.type() == std::filesystem::file_type::none) refuse("cannot be written", error);
    const bool replaces = std::filesystem::exists(old);
    if (replaces && !std::filesystem::is_regular_file(old)) refuse("exists and is not a regular file");
    if (replaces && is_read_only(old.permissions())) refuse("is read-only");
    target_ = behind_links(path);
    create_nameless();
    if (!file_) create_named();
    std::setvbuf(file_, nullptr, _IONBF, 0);  // the buffer is the caller's
    if (!replaces) return;
    std::filesystem::permissions(source_, old.permissions() & usual_permissions, error);
    if (error) fail("cannot get the permissions of the old file", error);
  }

  PendingFile(PendingFile&& other) noexcept
      : given_(std::move(other.given_)),
        target_(std::move(other.target_)),
        source_(std::exchange(other.source_, {})),
        file_(std::exchange(other.file_, nullptr)),
        nameless_(other.nameless_) {}
  PendingFile& operator=(PendingFile&&) = delete;

  ~PendingFile() { discard(); }

  /// The path that it was given.
  [[nodiscard]] const std::filesystem::path& given() const { return given_; }
  /// The path at which it will appear, with links followed.
  [[nodiscard]] const std::filesystem::path& target() const { return target_; }
  /// The path by which it can be accessed until it is published.
  [[nodiscard]] const std::filesystem::path& source() const { return source_; }

  void write(std::string_view text) {
    if (!file_) throw std::runtime_error(message(target_.string(), ": was committed or abandoned before"));
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("cannot write", last_error());
  }

  /// Overwrites the first text.size() characters of the file. Requires that the file is at least as long.
  void overwrite_begin(std::string_view text) {
    errno = 0;
    if (std::fseek(file_, 0, SEEK_SET) != 0) fail("cannot write", last_error());
    write(text);
    if (std::fseek(file_, 0, SEEK_END) != 0) fail("cannot write", last_error());
  }

  /// To be called when everything is written. A file without a name stays open, because closing deletes it.
  void complete() {
    errno = 0;
    if (!nameless_ && std::fclose(std::exchange(file_, nullptr)) != 0) fail("cannot write", last_error());
  }

  /// Replaces the target by the file, which has to be complete.
  void publish() {
    std::error_code error;
    if (nameless_) {
      error = link_to(target_);
      if (error == std::errc::file_exists) {  // a link cannot replace a file, but a file with a name can
        auto temporary = temporary_path();
        error = link_to(temporary);
        if (!error) source_ = std::move(temporary);
        if (!error) nameless_ = false;
      } else if (!error) {
        source_.clear();
      }
    }
    if (!error && !source_.empty()) std::filesystem::rename(source_, target_, error);
    if (error) fail("cannot put the new file in place", error);
    source_.clear();
    discard();
  }

  /// Hands over the file. The paths stay here as well, for messages.
  [[nodiscard]] PendingFile release() {
    auto given = given_, target = target_;
    PendingFile released(std::move(*this));
    given_ = std::move(given);
    target_ = std::move(target);
    return released;
  }

  void discard() noexcept {
    if (file_) std::fclose(std::exchange(file_, nullptr));
    std::error_code ignored;
    if (!nameless_ && !source_.empty()) std::filesystem::remove(source_, ignored);
    source_.clear();
  }

 private:
  static constexpr auto usual_permissions = std::filesystem::perms::all;  // rwx; not set-user-ID and such

  [[nodiscard]] static std::error_code last_error() { return {errno, std::generic_category()}; }

  /// A file without any write permission counts as read-only for the superuser as well.
  [[nodiscard]] bool is_read_only(std::filesystem::perms permissions) const {
    using std::filesystem::perms;
    if ((permissions & (perms::owner_write | perms::group_write | perms::others_write)) == perms::none) return true;
#if __has_include(<unistd.h>)
    return ::access(target_.c_str(), W_OK) != 0;
#else
    return false;
#endif
  }

  [[nodiscard]] std::filesystem::path folder() const {
    return target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  }

  /// Short, because the name of the target may already have the maximum length.
  [[nodiscard]] std::filesystem::path temporary_path() const {
    return folder() / message(".splinertia.", std::random_device()(), ".tmp");
  }

#ifdef O_TMPFILE
  void create_nameless() {
    const int descriptor = ::open(folder().c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) return;
    source_ = message("/proc/self/fd/", descriptor);
    nameless_ = true;
    // Without /proc it could not get a name later.
    if (::access(source_.c_str(), F_OK) == 0) file_ = ::fdopen(descriptor, "wb");
    if (!file_) ::close(descriptor);
  }
  [[nodiscard]] std::error_code link_to(const std::filesystem::path& name) const {
    errno = 0;
    ::linkat(AT_FDCWD, source_.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
    return last_error();
  }
#else
  void create_nameless() {}
  [[nodiscard]] std::error_code link_to(const std::filesystem::path&) const { return {}; }
#endif

  void create_named() {
    nameless_ = false;
    do {
      source_ = temporary_path();
      errno = 0;
      file_ = std::fopen(source_.string().c_str(), "wbx");
    } while (!file_ && errno == EEXIST);
    if (!file_) {
      source_.clear();
      refuse("cannot create a file beside it", last_error());
    }
  }

  [[noreturn]] void refuse(std::string_view what) const {
    throw std::runtime_error(message(target_.string(), ": ", what));
  }
  [[noreturn]] void refuse(std::string_view what, std::error_code error) const {
    refuse(message(what, ": ", error.message()));
  }
  [[noreturn]] void fail(std::string_view what, std::error_code error) {
    discard();
    throw WriteError(message(target_.string(), ": ", what, ": ", error.message()));
  }

  std::filesystem::path given_, target_, source_;
  std::FILE* file_ = nullptr;
  bool nameless_ = false;
};

}  // namespace splinertia::detail
