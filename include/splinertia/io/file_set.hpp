// SPDX-License-Identifier: MIT
/// Files that belong together, such as those of one run of a program.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <splinertia/detail/message.hpp>
#include <splinertia/io/detail/pending_file.hpp>
#include <splinertia/io/write_error.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace splinertia {

/// Replaces several files together. Even if the program is killed in between, old and new files never mix:
///
/// 1. the old files are removed, that of the last name first,
/// 2. the new ones appear in the order in which they were committed to the set.
///
/// So a set is complete if and only if the file that was committed to it last exists. If an exception or a signal comes
/// before commit(), the old files stay as they were.
///
///   FileSet set;
///   AtomicFile noise("noise.csv"), curves("curves.csv");
///   …
///   curves.commit(set);
///   noise.commit(set);    // readers look for this one
///   set.commit();
///
/// Files that a run reads can be kept: a set neither replaces nor removes them.
///
///   set.keep("imu.csv");
///   AtomicFile("./imu.csv").commit(set);    // throws
///
/// The caller has to ensure that no two sets are committed to the same paths at the same time.
class FileSet {
 public:
  /// Identifies a version of a file on the disk.
  struct Version {
    std::uintmax_t size;
    std::filesystem::file_time_type time;  // of the last change
    friend bool operator==(const Version&, const Version&) = default;
  };
  /// Throws std::filesystem::filesystem_error if there is no such file.
  [[nodiscard]] static Version version_of(const std::filesystem::path& path) {
    return {std::filesystem::file_size(path), std::filesystem::last_write_time(path)};
  }

  /// A file of the set: the path that its writer was given, and the version that will be there.
  struct Member {
    std::filesystem::path path;
    Version version;
  };
  [[nodiscard]] std::vector<Member> members() const {
    std::vector<Member> result;
    for (const auto& file : files_) result.push_back({file.given(), version_of(file.source())});
    return result;
  }

  /// Keeps a file that the run reads, whatever path leads to it: add() refuses to replace it and remove() leaves it.
  /// Call it before these. A path at which there is no regular file (a pipe, a placeholder) is allowed.
  void keep(std::filesystem::path path) { kept_.push_back(std::move(path)); }

  /// Whether a path leads to a kept file, also in another spelling, by a symbolic link or by another hard link.
  [[nodiscard]] bool keeps(const std::filesystem::path& path) const {
    std::error_code ignored;  // for paths at which there is nothing
    return std::any_of(kept_.begin(), kept_.end(),
                       [&](const auto& kept) { return std::filesystem::equivalent(kept, path, ignored); });
  }

  /// Throws std::invalid_argument if the file is kept; the message ends with what was `expected`. Programs call it
  /// before a long computation.
  void expect_not_kept(const std::filesystem::path& path, std::string_view expected = "another path") const {
    if (!keeps(path)) return;
    throw std::invalid_argument(
        detail::message(path.string(), ": is read by this run and would be replaced by it, expected ", expected));
  }

  /// Takes a complete file. Called by commit(FileSet&) of writers. Throws std::invalid_argument if the set already has
  /// a file for this path, or if the file there is kept.
  void add(detail::PendingFile file) {
    expect_not_kept(file.given());
    const auto path = std::filesystem::weakly_canonical(file.target());
    for (const auto& other : files_) {
      if (std::filesystem::weakly_canonical(other.target()) != path) continue;
      throw std::invalid_argument(detail::message(path.string(), ": is written twice, expected a path for each file"));
    }
    files_.push_back(std::move(file));
  }

  /// Names a file of an earlier run that this one does not write: commit() removes it, unless it is kept.
  void remove(std::filesystem::path path) {
    if (!keeps(path)) left_over_.push_back(std::move(path));
  }

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
    if (error) throw WriteError(detail::message(path.string(), ": cannot remove the old file: ", error.message()));
  }

  std::vector<detail::PendingFile> files_;
  std::vector<std::filesystem::path> kept_, left_over_;
};

}  // namespace splinertia
