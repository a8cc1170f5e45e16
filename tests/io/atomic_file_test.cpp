// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <splinertia/io/atomic_file.hpp>
#include <stdexcept>
#include <string>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#include <csignal>
#endif

using namespace splinertia;
using test::content;
using test::error_of;

TEST_CASE("the file appears with commit") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "out.txt";
  {
    AtomicFile file(path);
    file.append("x ");
    file.append_real(0.125);
    file.append(',');
    file.append_integer(-42);
    file.append(' ');
    file.append_seconds(std::chrono::milliseconds(1500));
    CHECK_FALSE(std::filesystem::exists(path));
    CHECK(folder.files() <= 1);  // a hidden one where files without names are not to be had
    file.commit();
    CHECK(content(path) == "x 0.125,-42 1.500000000");
    CHECK(error_of<std::runtime_error>([&] { file.commit(); }) ==
          path.string() + ": was committed or abandoned before");
  }
  CHECK(content(path) == "x 0.125,-42 1.500000000");
  CHECK(folder.files() == 1);
}

TEST_CASE("what is appended to a file that was committed or abandoned is refused at once") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "out.txt";
  const std::string refused = path.string() + ": was committed or abandoned before";
  const auto expect_refused = [&](AtomicFile& file) {
    CHECK(error_of<std::runtime_error>([&] { file.append('c'); }) == refused);
    CHECK(error_of<std::runtime_error>([&] { file.append("short"); }) == refused);
    CHECK(error_of<std::runtime_error>([&] { file.append_integer(1); }) == refused);
    CHECK(error_of<std::runtime_error>([&] { file.append_real(1); }) == refused);
    CHECK(error_of<std::runtime_error>([&] { (void)file.room(1); }) == refused);
    CHECK(error_of<std::runtime_error>([&] { (void)file.room(1'000'000); }) == refused);
    CHECK(error_of<std::runtime_error>([&] { file.overwrite_begin("x"); }) == refused);
    CHECK(error_of<std::runtime_error>([&] { file.commit(); }) == refused);
  };
  AtomicFile alone(path), abandoned(path), of_a_set(path);
  alone.append("text");
  alone.commit();
  expect_refused(alone);
  abandoned.append("text");
  abandoned.abandon();
  expect_refused(abandoned);
  FileSet set;
  of_a_set.append("text");
  of_a_set.commit(set);
  expect_refused(of_a_set);
  set.commit();
  expect_refused(of_a_set);
  CHECK(content(path) == "text");
  CHECK(folder.files() == 1);
}

TEST_CASE("without commit the old file stays and nothing else") {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("out.txt", "old");
  {
    AtomicFile file(path);
    file.append(std::string(1'000'000, 'x'));
  }
  CHECK(content(path) == "old");
  CHECK(folder.files() == 1);
  {
    AtomicFile file(path);
    file.append("new");
    file.commit();
  }
  CHECK(content(path) == "new");
}

TEST_CASE("texts longer than the buffer arrive whole") {
  const test::TemporaryDirectory folder;
  std::string expected;
  AtomicFile file(folder / "out.txt");
  for (int i = 0; i < 100'000; ++i) {
    const std::string text = std::to_string(i) + '\n';
    file.append(text);
    expected += text;
  }
  file.append(expected);
  expected += expected;
  file.commit();
  CHECK(content(folder / "out.txt") == expected);
}

TEST_CASE("NaN and infinity are not written, nor half a file that had one") {
  const test::TemporaryDirectory folder;
  using Limits = std::numeric_limits<double>;
  for (const double value : {Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    AtomicFile file(folder / "out.txt");
    file.append("half a row ");
    CHECK_THROWS_AS(file.append_real(value), std::invalid_argument);
    CHECK(folder.files() == 0);
    CHECK_THROWS_AS(file.commit(), std::runtime_error);
  }
  const auto path = folder / "out.txt";
  CHECK(error_of<std::invalid_argument>([&] { AtomicFile(path).append_real(Limits::infinity()); }) ==
        path.string() + ": cannot write inf, expected a finite number");
}

TEST_CASE("callers may write into the buffer themselves") {
  const test::TemporaryDirectory folder;
  std::string expected;
  AtomicFile file(folder / "out.txt");
  for (const std::size_t size : {1u, 65'535u, 2u, 65'536u, 200'000u, 3u, 70'000u}) {
    char* const room = file.room(size + 5);
    std::fill(room, room + size, static_cast<char>('a' + expected.size() % 26));
    expected.append(size, static_cast<char>('a' + expected.size() % 26));
    file.advance(room + size);
  }
  file.append(expected);
  expected += expected;
  file.commit();
  CHECK(content(folder / "out.txt") == expected);
}

TEST_CASE("the beginning may be written last") {
  const test::TemporaryDirectory folder;
  for (const std::size_t size : {10u, 1'000'000u}) {
    const std::string text(size, 'x');
    AtomicFile file(folder / "out.txt");
    file.append("0000 rows\n");
    file.append(text);
    file.overwrite_begin("1234");
    file.append("end");
    file.commit();
    CHECK(content(folder / "out.txt") == "1234 rows\n" + text + "end");
    CHECK_THROWS_AS(file.overwrite_begin("5678"), std::runtime_error);
  }
}

TEST_CASE("places that cannot be written are named") {
  const test::TemporaryDirectory folder;
  const auto nowhere = folder / "missing/out.txt";
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(nowhere); }) ==
        nowhere.string() + ": cannot create a file beside it: No such file or directory");
  const auto below_file = folder.write("file", "") / "out.txt";
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(below_file); }) ==
        below_file.string() + ": cannot create a file beside it: Not a directory");
  const auto directory = folder / "directory";
  std::filesystem::create_directory(directory);
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(directory); }) ==
        directory.string() + ": exists and is not a regular file");
  CHECK(folder.files() == 2);
}

TEST_CASE("a link is followed, not replaced") {
  const test::TemporaryDirectory folder;
  std::filesystem::create_directory(folder / "real");
  const auto real = folder.write("real/out.txt", "old"), link = folder / "link.txt";
  std::filesystem::create_symlink(real, link);
  AtomicFile file(link);
  file.append("new");
  file.commit();
  CHECK(std::filesystem::is_symlink(link));
  CHECK(content(real) == "new");
}

TEST_CASE("links are followed to files that are not there yet, and along chains") {
  const test::TemporaryDirectory folder;
  std::filesystem::create_directory(folder / "real");
  std::filesystem::create_symlink("real/out.txt", folder / "second.txt");  // as seen from its folder
  std::filesystem::create_symlink(folder / "second.txt", folder / "first.txt");
  for (const char* text : {"first time", "and again"}) {
    AtomicFile file(folder / "first.txt");
    file.append(text);
    file.commit();
    CHECK(std::filesystem::is_symlink(folder / "first.txt"));
    CHECK(std::filesystem::is_symlink(folder / "second.txt"));
    CHECK(content(folder / "real/out.txt") == text);
  }
}

TEST_CASE("links that lead nowhere are refused") {
  const test::TemporaryDirectory folder;
  std::filesystem::create_symlink("b.txt", folder / "a.txt");
  std::filesystem::create_symlink("a.txt", folder / "b.txt");
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(folder / "a.txt"); }) ==
        (folder / "a.txt").string() + ": cannot be written: Too many levels of symbolic links");
  std::filesystem::create_symlink("missing/out.txt", folder / "c.txt");
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(folder / "c.txt"); }) ==
        (folder / "missing/out.txt").string() + ": cannot create a file beside it: No such file or directory");
  std::filesystem::create_symlink("/dev/null", folder / "d.txt");
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(folder / "d.txt"); }) ==
        (folder / "d.txt").string() + ": exists and is not a regular file");
  CHECK(folder.files() == 4);
}

TEST_CASE("the permissions of the old file stay") {
  using std::filesystem::perms;
  const test::TemporaryDirectory folder;
  for (const auto old : {perms(0600), perms(0664), perms(0755), perms(0220)}) {
    const auto path = folder.write("out.txt", "old");
    std::filesystem::permissions(path, old);
    AtomicFile file(path);
    file.append("new");
    file.commit();
    CHECK(std::filesystem::status(path).permissions() == old);
    std::filesystem::permissions(path, perms(0600));
    CHECK(content(path) == "new");
  }
}

TEST_CASE("a read-only file is refused, for the superuser too") {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("out.txt", "old");
  std::filesystem::permissions(path, std::filesystem::perms(0444));
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(path); }) == path.string() + ": is read-only");
  CHECK(content(path) == "old");
}

TEST_CASE("the longest names can be written, longer ones are refused at once") {
  const test::TemporaryDirectory folder;
  const auto longest = folder / std::string(255, 'x'), longer = folder / std::string(256, 'x');
  for (const char* text : {"once", "twice"}) {
    AtomicFile file(longest);
    file.append(text);
    file.commit();
    CHECK(content(longest) == text);
  }
  CHECK(error_of<std::runtime_error>([&] { AtomicFile file(longer); }) ==
        longer.string() + ": cannot be written: File name too long");
  CHECK(folder.files() == 1);
}

TEST_CASE("other hard links keep the old text") {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("out.txt", "old");
  std::filesystem::create_hard_link(path, folder / "other.txt");
  AtomicFile file(path);
  file.append("new");
  file.commit();
  CHECK(content(path) == "new");
  CHECK(content(folder / "other.txt") == "old");
}

#if __has_include(<sys/resource.h>)
TEST_CASE("a full disk is reported and leaves nothing") {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("out.txt", "old");
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100'000, before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const std::string error = error_of<WriteError>([&] {
    AtomicFile file(path);
    file.append(std::string(1'000'000, 'x'));
    file.commit();
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(error == path.string() + ": cannot write: File too large");
  CHECK(content(path) == "old");
  CHECK(folder.files() == 1);
}
#endif
