// SPDX-License-Identifier: MIT
#include "support/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "support/concat.hpp"
#include "support/formatted.hpp"

using namespace splinertia;

namespace {

/// A lock on a folder, held by one program at a time. Without effect if the file system has no locks.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

 private:
  int descriptor_;
};

/// The size and time of a file when the program wrote it; nothing if a script writes it.
using Written = std::optional<FileSet::Version>;

/// The time as std::int64_t, because libc++ counts in 128-bit integers, which streams cannot print.
std::int64_t nanoseconds_of(std::filesystem::file_time_type time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

/// A line of the list: name, size in bytes and time of the last change, or the name alone.
std::string line_of(const std::string& name, const Written& written) {
  return written ? concat(name, ' ', written->size, ' ', nanoseconds_of(written->time), '\n') : name + '\n';
}

/// A name is listed twice if the program was killed before it replaced the file.
std::map<std::string, std::vector<Written>> read_list(const std::filesystem::path& path) {
  std::map<std::string, std::vector<Written>> list;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string name;
    if (!(fields >> name) || name[0] == '#' || name.find('/') != name.npos) continue;
    Written written;
    std::uintmax_t size = 0;
    std::int64_t time = 0;
    if (fields >> size >> time) {
      written = {size, std::filesystem::file_time_type(std::chrono::nanoseconds(time))};
    } else if (!fields.eof()) {
      continue;  // not a line of this list
    }
    list[name].push_back(written);
  }
  return list;
}

void create(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(concat(folder.string(), ": cannot create this folder: ", error.message()));
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path folder, std::string_view program, const Inputs& inputs)
    : folder_(std::move(folder)), list_(folder_ / concat('.', program, ".files")), program_(program) {
  keep_inputs(files_, inputs);
  expect_no_inputs({list_.filename().string()});
}

void OutputFolder::expect_no_inputs(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) files_.expect_not_kept(folder_ / name, "another --output folder");
}

std::filesystem::path OutputFolder::path(std::string_view name) {
  expect_no_inputs({name});
  create(folder_);
  names_.emplace_back(name);
  return folder_ / name;
}

/// Marks files that only an earlier run wrote for removal. Returns the text of the list while files of both runs exist.
std::string OutputFolder::list_and_remove_left_over() {
  std::string text =
      concat("# Files that ", program_, " has written here. Its next run removes those that it does not write.\n");
  std::vector<std::string> removed;
  for (const auto& [name, versions] : read_list(list_)) {
    const auto path = folder_ / name;
    if (!std::filesystem::is_regular_file(path)) continue;
    const FileSet::Version now = FileSet::version_of(path);
    const bool own = std::any_of(versions.begin(), versions.end(), [&](const Written& w) { return !w || *w == now; });
    if (own) text += line_of(name, now);
    if (contains(names_, name)) continue;
    if (own && files_.keeps(path)) {
      std::fprintf(stderr, "%s: note: %s stays: an earlier run wrote it, but this one reads it\n", program_.c_str(),
                   path.c_str());
    } else if (own) {
      files_.remove(std::filesystem::canonical(path));
      removed.push_back(name);
    } else if (!contains(expected_, name)) {
      std::fprintf(stderr, "%s: note: %s stays: an earlier run wrote it, but it has been changed since\n",
                   program_.c_str(), path.c_str());
    }
  }
  for (const std::string& name : expected_) {
    if (contains(removed, name) || !std::filesystem::exists(folder_ / name)) text += line_of(name, std::nullopt);
  }
  for (const auto& [path, version] : files_.members()) {
    for (const std::string& name : names_) {
      if (path == folder_ / name) text += line_of(name, version);
    }
  }
  return text;
}

std::string OutputFolder::commit() {
  const FolderLock lock(folder_);
  AtomicFile list(list_);
  list.append(list_and_remove_left_over());
  list.commit();
  files_.commit();
  return list_of(names_);
}
