// SPDX-License-Identifier: MIT
#include <splinertia/io/text_file.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using test::error_of;
using Fields = std::vector<std::string_view>;

namespace {

Fields split(std::string_view line) {
  Fields fields{"left over"};
  split_fields(line, fields);
  return fields;
}

using Lines = std::vector<std::pair<std::size_t, std::string>>;

Lines lines(const std::filesystem::path& path) {
  Lines result;
  TextFile file(path);
  while (file.next()) result.emplace_back(file.line_number(), std::string(file.line()));
  return result;
}

}  // namespace

TEST_CASE("fields stand between commas or blanks") {
  CHECK(split("1 2\t 3") == Fields{"1", "2", "3"});
  CHECK(split("  1  2  ") == Fields{"1", "2"});
  CHECK(split("1,2, 3 ,4") == Fields{"1", "2", "3", "4"});
  CHECK(split("1,,3,") == Fields{"1", "", "3", ""});
  CHECK(split(",") == Fields{"", ""});
  CHECK(split("1 2,3") == Fields{"1 2", "3"});
  CHECK(split("one") == Fields{"one"});
  CHECK(split(" ").empty());
}

TEST_CASE("only lines of data count, with their numbers") {
  const test::TemporaryDirectory folder;
  CHECK(lines(folder.write("plain", "a\nb")) == Lines{{1, "a"}, {2, "b"}});
  CHECK(lines(folder.write("unix", "# head\n\na 1\n \t\n  # more\n b 2 \n")) == Lines{{3, "a 1"}, {6, "b 2"}});
  CHECK(lines(folder.write("windows", "\xEF\xBB\xBF# head\r\n\r\na 1\r\nb 2\r\n")) == Lines{{3, "a 1"}, {4, "b 2"}});
  CHECK(lines(folder.write("mark",
                           "\xEF\xBB\xBF"
                           "a\n")) == Lines{{1, "a"}});
  CHECK(lines(folder.write("empty", "")).empty());
}

TEST_CASE("lines may begin and end anywhere in the blocks that are read") {
  const test::TemporaryDirectory folder;
  constexpr std::size_t block = 1 << 16;
  for (const std::size_t first : {block - 3, block - 2, block - 1, block, block + 1, 2 * block, 5 * block + 7}) {
    const std::string a(first, 'a'), c(3 * block, 'c');
    CHECK(lines(folder.write("unix", a + "\nb\n" + c)) == Lines{{1, a}, {2, "b"}, {3, c}});
    CHECK(lines(folder.write("windows", a + "\r\nb\r\n\r\n" + c + "\r\n")) == Lines{{1, a}, {2, "b"}, {4, c}});
    CHECK(lines(folder.write("one", a)) == Lines{{1, a}});
    CHECK(lines(folder.write("marks", "\xEF\xBB\xBF#" + a + "\nb")) == Lines{{2, "b"}});
  }
  std::string text;
  Lines expected;
  for (std::size_t i = 1; i < 60'000; ++i) {
    expected.emplace_back(i, std::string(1 + i * i % 13, static_cast<char>('a' + i % 26)));
    text += expected.back().second + '\n';
  }
  CHECK((lines(folder.write("many", text)) == expected));
}

TEST_CASE("progress goes from 0 to 1") {
  const test::TemporaryDirectory folder;
  TextFile file(folder.write("data", "1234\n123456789\n12345"));
  CHECK(file.progress() == 0);
  REQUIRE(file.next());
  CHECK(file.progress() == 0.25);
  REQUIRE(file.next());
  CHECK(file.progress() == 0.75);
  REQUIRE(file.next());
  CHECK_FALSE(file.next());
  CHECK(file.progress() == 1);
  CHECK(TextFile(folder.write("empty", "")).progress() == 0);
}

TEST_CASE("what cannot be opened is named") {
  const test::TemporaryDirectory folder;
  const auto missing = folder / "missing.txt";
  CHECK(error_of<std::runtime_error>([&] { TextFile file(missing); }) ==
        missing.string() + ": cannot open: No such file or directory");
  const auto directory = (folder / "").parent_path();
  CHECK(error_of<std::runtime_error>([&] { TextFile file(directory); }) ==
        directory.string() + ": is a directory, expected a file");
}

TEST_CASE("a failure names file and line") {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("data", "# head\nfirst\n");
  TextFile file(path);
  CHECK(error_of<std::runtime_error>([&] { file.fail("early"); }) == path.string() + ": early");
  REQUIRE(file.next());
  CHECK(error_of<std::runtime_error>([&] { file.fail("bad ", 0.5); }) == path.string() + ":2: bad 0.5");
}

TEST_CASE("excerpts stay short and on one line") {
  CHECK(excerpt("1.5") == "\"1.5\"");
  CHECK(excerpt("a\rb\x1b[0m") == "\"a?b?[0m\"");
  CHECK(excerpt(std::string(100, 'x'), 100) == "\"" + std::string(100, 'x') + "\"");
  CHECK(excerpt(std::string(100, 'x')) == "\"" + std::string(40, 'x') + "…\"");
}
