// SPDX-License-Identifier: MIT
#include <array>
#include <filesystem>
#include <splinertia/io/detail/input_file.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using test::error_of;

TEST_CASE("bytes come in pieces of the reader's choice") {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("data", std::string_view("ab\0\r\nf", 6));
  InputFile file(path);
  CHECK(file.size() == 6);
  CHECK(file.path() == path.string());
  std::array<char, 4> bytes{};
  CHECK(file.read(bytes.data(), 4) == 4);
  CHECK(std::string_view(bytes.data(), 4) == std::string_view("ab\0\r", 4));
  CHECK(file.read(bytes.data(), 4) == 2);
  CHECK(std::string_view(bytes.data(), 2) == "\nf");
  CHECK(file.read(bytes.data(), 4) == 0);
  CHECK_FALSE(file.failed());
}

TEST_CASE("what cannot be opened is named with the reason") {
  const test::TemporaryDirectory folder;
  const auto missing = folder / "missing";
  CHECK(error_of<std::runtime_error>([&] { InputFile file(missing); }) ==
        missing.string() + ": cannot open: No such file or directory");
  const auto directory = (folder / "").parent_path();
  CHECK(error_of<std::runtime_error>([&] { InputFile file(directory); }) ==
        directory.string() + ": is a directory, expected a file");
}

#if __has_include(<sys/stat.h>)
TEST_CASE("the size of what is no regular file is not known") { CHECK(InputFile("/dev/null").size() == 0); }
#endif
