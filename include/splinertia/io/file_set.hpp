// SPDX-License-Identifier: MIT
/// Files that belong together, such as those of one run of a program.
#pragma once

#include <splinertia/cpp20.hpp>

#include <cstdint>
#include <filesystem>
#include <splinertia/io/detail/pending_file.hpp>
#include <splinertia/io/write_error.hpp>
#include <splinertia/message.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace splinertia {

/// Puts files in place together. What is killed in between never leaves old and new files side by side:
///
/// 1. the old files are removed, that of the last name first,
/// 2. the new ones appear in the order in which they were committed to the set.
///
/// Thus a set is complete if and only if the file that was committed last is there. Until commit(), and for ever if an
/// exception or a signal comes in between, the old files are as they were.
///
///   FileSet set;
///   AtomicFile noise("noise.csv"), curves("curves.csv");
///   …
///   curves.commit(set);
///   noise.commit(set);    // readers look for this one
///   set.commit();
///
/// Two sets that are committed at the same time to the same paths must be kept apart by the caller.
class FileSet {
 public:
  /// What a file on the disk is known by.
  struct Version {
    std::uintmax_t size;
    std::filesystem::file_time_type time;  // of the last change
    friend bool operator==(const Version&, const Version&) = default;
  };
  /// Throws std::filesystem::filesystem_error if there is no such file.
  [[nodiscard]] static Version version_of(const std::filesystem::path& path) {
    return {std::filesystem::file_size(path), std::filesystem::last_write_time(path)};
  }

  /// A file of the set: the path that its writer was given, and what it is going to be there.
  struct Member {
    std::filesystem::path path;
    Version version;
  };
  [[nodiscard]] std::vector<Member> members() const {
    std::vector<Member> result;
    for (const auto& file : files_) result.push_back({file.given(), version_of(file.source())});
    return result;
  }

  /// Takes a complete file. Called by the commit(FileSet&) of writers. Throws std::invalid_argument if the set has one
  /// of this path.
  void add(detail::PendingFile file) {
    const auto path = std::filesystem::weakly_canonical(file.target());
    for (const auto& other : files_) {
      if (std::filesystem::weakly_canonical(other.target()) != path) continue;
      throw std::invalid_argument(message(path.string(), ": is written twice, expected a path for each file"));
    }
    files_.push_back(std::move(file));
  }

  /// A file that an earlier run has left and that this one does not have: commit() removes it.
  void remove(std::filesystem::path path) { left_over_.push_back(std::move(path)); }

  /// Replaces the old files by the new ones. Throws WriteError with path and reason if the system refuses.
  void commit() {
    if (files_.size() + left_over_.size() > 1) {  // a single file replaces the old one
      for (auto file = files_.rbegin(); file != files_.rend(); ++file) remove_now(file->target());
      for (const auto& path : left_over_) remove_now(path);
    }
    for (auto& file : files_) file.publish();
    files_.clear();
    left_over_.clear();
  }

 private:
  static void remove_now(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error) throw WriteError(message(path.string(), ": cannot remove the old file: ", error.message()));
  }

  std::vector<detail::PendingFile> files_;
  std::vector<std::filesystem::path> left_over_;
};

}  // namespace splinertia
