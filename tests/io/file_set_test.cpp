// SPDX-License-Identifier: MIT
#include <splinertia/io/file_set.hpp>

#include <filesystem>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/npy_imu.hpp>
#include <splinertia/io/tum.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "support/catch.hpp"
#include "temporary_directory.hpp"

#if __has_include(<sys/wait.h>)
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#endif

using namespace splinertia;
using test::content;
using test::error_of;

namespace {

void add(FileSet& set, const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.append(text);
  file.commit(set);
}

}  // namespace

TEST_CASE("files of a set appear with its commit") {
  const test::TemporaryDirectory folder;
  folder.write("a.txt", "old a");
  folder.write("left.txt", "old");
  folder.write("notes.txt", "of somebody else");
  FileSet set;
  add(set, folder / "a.txt", "new a");
  add(set, folder / "b.txt", "new b");
  set.remove(folder / "left.txt");
  set.remove(folder / "never.txt");
  CHECK(content(folder / "a.txt") == "old a");
  CHECK_FALSE(std::filesystem::exists(folder / "b.txt"));
  CHECK(std::filesystem::exists(folder / "left.txt"));
  set.commit();
  CHECK(content(folder / "a.txt") == "new a");
  CHECK(content(folder / "b.txt") == "new b");
  CHECK(content(folder / "notes.txt") == "of somebody else");
  CHECK(folder.files() == 3);
  set.commit();  // nothing more to do
  CHECK(folder.files() == 3);
}

TEST_CASE("a set that is not committed leaves nothing") {
  const test::TemporaryDirectory folder;
  folder.write("a.txt", "old a");
  {
    FileSet set;
    add(set, folder / "a.txt", "new a");
    add(set, folder / "b.txt", "new b");
    set.remove(folder / "a.txt");
  }
  CHECK(content(folder / "a.txt") == "old a");
  CHECK(folder.files() == 1);
}

TEST_CASE("every writer can commit to a set") {
  const test::TemporaryDirectory folder;
  const ImuSample<double, std::chrono::nanoseconds> sample{std::chrono::nanoseconds(1), {0, 0, 1}, {0, 0, 9.81}};
  EurocState state{};
  state.time = sample.time;
  FileSet set;
  EurocImuWriter imu(folder / "imu.csv");
  NpyImuWriter npy(folder / "imu.npy");
  EurocGroundtruthWriter truth(folder / "truth.csv");
  TumWriter tum(folder / "poses.tum");
  imu.append(sample);
  npy.append(sample);
  truth.append(state);
  tum.append(Stamped<SO3xR3<double>>{sample.time, state.value});
  imu.commit(set);
  npy.commit(set);
  truth.commit(set);
  tum.commit(set);
  CHECK(set.members().size() == 4);
  CHECK(set.members()[1].path == folder / "imu.npy");
  set.commit();
  CHECK(read_euroc_imu(folder / "imu.csv").size() == 1);
  CHECK(read_npy_imu(folder / "imu.npy").size() == 1);
  CHECK(read_euroc_groundtruth(folder / "truth.csv").size() == 1);
  CHECK(read_tum(folder / "poses.tum").size() == 1);
  CHECK(folder.files() == 4);
}

TEST_CASE("members say what the files are going to be") {
  const test::TemporaryDirectory folder;
  FileSet set;
  add(set, folder / "a.txt", "12345");
  const auto members = set.members();
  REQUIRE(members.size() == 1);
  set.commit();
  CHECK(members[0].version.size == 5);
  CHECK(members[0].version == FileSet::version_of(folder / "a.txt"));
}

TEST_CASE("two files of one path are refused") {
  const test::TemporaryDirectory folder;
  std::filesystem::create_symlink("a.txt", folder / "link.txt");
  FileSet set;
  add(set, folder / "a.txt", "once");
  for (const char* same : {"a.txt", "./a.txt", "link.txt"}) {
    CHECK(error_of<std::invalid_argument>([&] {
            add(set, folder / same, "twice");
          }).find("a.txt: is written twice, expected a path for each file") != std::string::npos);
  }
  set.commit();
  CHECK(content(folder / "a.txt") == "once");
}

TEST_CASE("a file that cannot be removed is named") {
  const test::TemporaryDirectory folder;
  folder.write("left.txt/", "");
  std::filesystem::create_directories(folder / "left.txt/full");
  FileSet set;
  add(set, folder / "a.txt", "new a");
  set.remove(folder / "left.txt");
  CHECK(error_of<WriteError>([&] { set.commit(); }) ==
        (folder / "left.txt").string() + ": cannot remove the old file: Directory not empty");
}

TEST_CASE("what a run reads is neither replaced nor removed, whatever path leads to it") {
  const test::TemporaryDirectory folder;
  folder.write("input.txt", "input");
  folder.write("left.txt", "input, too");
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink("input.txt", folder / "link.txt");
  std::filesystem::create_hard_link(folder / "input.txt", folder / "hard.txt");
  FileSet set;
  set.keep(folder / "sub/../input.txt");
  set.keep(folder / "left.txt");
  set.keep(folder / "missing.txt");
  set.keep("-");
  for (const char* name : {"input.txt", "./input.txt", "link.txt", "hard.txt"}) {
    INFO(name);
    const auto path = folder / name;
    CHECK(set.keeps(path));
    CHECK(error_of<std::invalid_argument>([&] { add(set, path, "output"); }) ==
          path.string() + ": is read by this run and would be replaced by it, expected another path");
    CHECK(error_of<std::invalid_argument>([&] { set.expect_not_kept(path, "another folder"); }) ==
          path.string() + ": is read by this run and would be replaced by it, expected another folder");
  }
  add(set, folder / "a.txt", "new a");
  add(set, folder / "missing.txt", "new");
  set.expect_not_kept(folder / "b.txt");
  set.remove(folder / "./left.txt");
  set.commit();
  CHECK(content(folder / "input.txt") == "input");
  CHECK(content(folder / "left.txt") == "input, too");
  CHECK(content(folder / "a.txt") == "new a");
  CHECK(folder.files() == 7);
}

TEST_CASE("a link may be kept, and a link to nothing that is there") {
  const test::TemporaryDirectory folder;
  folder.write("input.txt", "input");
  std::filesystem::create_symlink("input.txt", folder / "link.txt");
  std::filesystem::create_symlink("nothing.txt", folder / "nowhere.txt");
  FileSet set;
  set.keep(folder / "link.txt");
  CHECK(set.keeps(folder / "input.txt"));
  CHECK_FALSE(set.keeps(folder / "nowhere.txt"));
  add(set, folder / "nowhere.txt", "new");
  CHECK_THROWS_AS(add(set, folder / "input.txt", "new"), std::invalid_argument);
}

#if __has_include(<sys/wait.h>)
TEST_CASE("a process that ends before the commit leaves nothing") {
  const test::TemporaryDirectory folder;
  const pid_t child = fork();
  if (child == 0) {
    FileSet set;
    AtomicFile unfinished(folder / "b.txt");
    unfinished.append(std::string(1'000'000, 'x'));
    add(set, folder / "a.txt", "new a");
    ::kill(::getpid(), SIGKILL);
  }
  REQUIRE(child > 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
#ifdef O_TMPFILE
  CHECK(folder.files() == 0);
#endif
}
#endif
