// SPDX-License-Identifier: MIT
#include "support/output_folder.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <splinertia/io/atomic_file.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "../io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using test::content;

namespace {

/// A run that writes these files, the text into each.
std::string run(const std::filesystem::path& path, std::initializer_list<const char*> names, std::string_view text,
                bool pictures = false, const Inputs& inputs = {}) {
  OutputFolder folder(path, "program", inputs);
  if (pictures) folder.expect_pictures("plot");
  for (const char* name : names) {
    AtomicFile file(folder.path(name));
    file.append(text);
    file.commit(folder.files());
  }
  return folder.commit();
}

}  // namespace

TEST_CASE("what an earlier run has left is removed, and nothing else") {
  const test::TemporaryDirectory folder;
  folder.write("notes.txt", "mine");
  folder.write("c.txt", "mine, too");
  CHECK(run(folder / ".", {"a.txt", "b.txt"}, "first") == "a.txt and b.txt");
  CHECK(run(folder / ".", {"a.txt"}, "second") == "a.txt");
  CHECK(content(folder / "a.txt") == "second");
  CHECK_FALSE(exists(folder / "b.txt"));
  CHECK(content(folder / "notes.txt") == "mine");
  CHECK(content(folder / "c.txt") == "mine, too");
  CHECK(exists(folder / ".program.files"));
  CHECK(folder.files() == 4);
}

TEST_CASE("what was changed since stays") {
  const test::TemporaryDirectory folder;
  CHECK(run(folder / ".", {"a.txt", "b.txt", "c.txt"}, "first") == "a.txt, b.txt and c.txt");
  folder.write("b.txt", "mine now");
  const auto time = std::filesystem::last_write_time(folder / "c.txt");
  folder.write("c.txt", "FIRST");  // of the same size
  std::filesystem::last_write_time(folder / "c.txt", time + std::chrono::milliseconds(1));
  (void)run(folder / ".", {"a.txt"}, "second");
  CHECK(content(folder / "b.txt") == "mine now");
  CHECK(content(folder / "c.txt") == "FIRST");
}

TEST_CASE("the list outlives a run that was killed before it could replace the files") {
  const test::TemporaryDirectory folder;
  (void)run(folder / ".", {"a.txt", "b.txt"}, "first");
  std::filesystem::create_directory(folder / "kept");
  for (const char* name : {"a.txt", "b.txt"}) std::filesystem::copy(folder / name, folder / "kept" / name);
  for (const char* name : {"a.txt", "b.txt"}) {
    std::filesystem::last_write_time(folder / "kept" / name, std::filesystem::last_write_time(folder / name));
  }
  (void)run(folder / ".", {"a.txt", "b.txt"}, "killed");
  for (const char* name : {"a.txt", "b.txt"}) std::filesystem::rename(folder / "kept" / name, folder / name);
  (void)run(folder / ".", {"a.txt"}, "third");
  CHECK_FALSE(exists(folder / "b.txt"));
}

TEST_CASE("pictures of an earlier run are removed, those of others are not") {
  const test::TemporaryDirectory folder;
  folder.write("plot.svg", "mine");
  (void)run(folder / ".", {"a.txt"}, "first", true);
  folder.write("plot.png", "drawn by a script");
  (void)run(folder / ".", {"a.txt"}, "second", true);
  CHECK_FALSE(exists(folder / "plot.png"));
  CHECK(exists(folder / "plot.svg"));
  folder.write("plot.png", "drawn again");
  (void)run(folder / ".", {"a.txt"}, "third");
  CHECK_FALSE(exists(folder / "plot.png"));
}

TEST_CASE("links in the folder are followed and stay") {
  const test::TemporaryDirectory folder;
  std::filesystem::create_directories(folder / "elsewhere");
  std::filesystem::create_directories(folder / "out");
  std::filesystem::create_directory_symlink("out", folder / "link");
  std::filesystem::create_symlink("../elsewhere/a.txt", folder / "out/a.txt");
  std::filesystem::create_symlink("../elsewhere/b.txt", folder / "out/b.txt");
  (void)run(folder / "link", {"a.txt", "b.txt"}, "first");
  (void)run(folder / "link", {"b.txt"}, "second");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(std::filesystem::is_symlink(folder / "out/a.txt"));
  CHECK_FALSE(exists(folder / "elsewhere/a.txt"));
  CHECK(content(folder / "elsewhere/b.txt") == "second");
}

TEST_CASE("what a run reads is neither replaced nor removed") {
  const test::TemporaryDirectory folder;
  CHECK(run(folder / ".", {"a.txt", "b.txt"}, "first") == "a.txt and b.txt");
  std::filesystem::create_symlink("b.txt", folder / "link.txt");
  for (const char* input : {"b.txt", "link.txt"}) {
    const Inputs inputs{folder / input, "", folder / "missing.txt"};
    const std::string refused = (folder / "./b.txt").string() +
                                ": is read by this run and would be replaced by it, expected another --output folder";
    OutputFolder output(folder / ".", "program", inputs);
    output.expect_no_inputs({"a.txt", "c.txt"});
    CHECK(test::error_of<std::invalid_argument>([&] { output.expect_no_inputs({"a.txt", "b.txt"}); }) == refused);
    CHECK(test::error_of<std::invalid_argument>([&] { (void)output.path("b.txt"); }) == refused);
    (void)run(folder / ".", {"a.txt"}, "second", false, inputs);
    CHECK(content(folder / "b.txt") == "first");
  }
  (void)run(folder / ".", {"a.txt"}, "third");  // which does not read it
  CHECK_FALSE(exists(folder / "b.txt"));
}

TEST_CASE("a picture that a run reads is not drawn over, and its own list is not its input") {
  const test::TemporaryDirectory folder;
  folder.write("plot.svg", "input");
  OutputFolder output(folder / ".", "program", {folder / "plot.svg"});
  CHECK_THROWS_AS(output.expect_pictures("plot"), std::invalid_argument);
  folder.write(".program.files", "a.txt\n");
  CHECK_THROWS_AS(OutputFolder(folder / ".", "program", {folder / ".program.files"}), std::invalid_argument);
}

TEST_CASE("the files of a ROS 2 bag are inputs") {
  const test::TemporaryDirectory folder;
  std::filesystem::create_directory(folder / "bag");
  folder.write("bag/metadata.yaml", "input");
  folder.write("bag/notes.txt", "mine");
  OutputFolder output(folder / "bag", "program", {folder / "bag"});
  CHECK_THROWS_AS(output.path("metadata.yaml"), std::invalid_argument);
  CHECK_NOTHROW(output.path("notes.txt"));
}

TEST_CASE("the folder is made for the first file, not before") {
  const test::TemporaryDirectory folder;
  OutputFolder output(folder / "new", "program", {});
  output.expect_no_inputs({"a.txt"});
  CHECK(folder.files() == 0);
  (void)output.path("a.txt");
  CHECK(exists(folder / "new"));
}

TEST_CASE("a list that names files outside of the folder removes none") {
  const test::TemporaryDirectory folder;
  folder.write("outside.txt", "mine");
  std::filesystem::create_directory(folder / "out");
  folder.write("out/.program.files", "../outside.txt\n" + (folder / "outside.txt").string() + "\n\n..\n");
  (void)run(folder / "out", {"a.txt"}, "text");
  CHECK(content(folder / "outside.txt") == "mine");
}
