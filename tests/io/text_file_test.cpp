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

TEST_CASE("numbers are read at once where a line has nothing else") {
  const test::TemporaryDirectory folder;
  std::string text =
      "\xEF\xBB\xBF"
      "1\n# 2\n\n-3.5e-2\n2.5\n 4\n5\r\n6,7\nnan\n8";
  TextFile file(folder.write("numbers.txt", text));
  std::vector<std::string> found;
  for (double number = 0;;) {
    if (file.next_number(number)) {
      found.push_back(std::to_string(file.line_number()) + " number " + std::to_string(number));
    } else if (file.next()) {
      found.push_back(std::to_string(file.line_number()) + " line " + std::string(file.line()));
    } else {
      break;
    }
  }
#if defined(__SIZEOF_INT128__)
  CHECK(found == std::vector<std::string>{"1 line 1", "4 line -3.5e-2", "5 number 2.500000", "6 line 4", "7 line 5",
                                          "8 line 6,7", "9 line nan", "10 line 8"});
#else
  CHECK(found.size() == 8);
#endif
}

TEST_CASE("numbers at the ends of blocks are whole") {
  const test::TemporaryDirectory folder;
  std::string text;
  for (int i = 0; i < 60'000; ++i) text += std::to_string(i * 7.25) + '\n';
  TextFile file(folder.write("numbers.txt", text));
  int count = 0;
  for (double number = 0;; ++count) {
    if (!file.next_number(number)) {
      if (!file.next()) break;
      number = std::stod(std::string(file.line()));
    }
    REQUIRE(number == count * 7.25);
  }
  CHECK(count == 60'000);
  CHECK(file.line_number() == 60'000);
}
