// SPDX-License-Identifier: MIT
// What every format owes to its table is checked once, here.
#include <array>
#include <chrono>
#include <cstddef>
#include <random>
#include <splinertia/io/stamped_table.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

constexpr std::array<std::string_view, 4> columns{"t", "x [m]", "y [m]", "z [m]"};
constexpr TableLayout nanosecond_points{.format = "points",
                                        .columns = columns,
                                        .fewest_columns = 2,
                                        .stamp = TableLayout::Stamp::nanoseconds,
                                        .separator = ',',
                                        .header = true};
constexpr TableLayout second_points{.format = "points",
                                    .columns = columns,
                                    .fewest_columns = 4,
                                    .stamp = TableLayout::Stamp::seconds,
                                    .separator = ' ',
                                    .header = false};

// The message about a file of this content, without the path in front.
std::string error_in(std::string_view text, const TableLayout& layout) {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("points", text);
  const std::string error = test::error_of<std::runtime_error>(
      [&] { (void)read_stamped_table(path, layout, [](const StampedTable& row) { return row.time(); }); });
  REQUIRE(error.starts_with(path.string() + ":"));
  REQUIRE(error.find('\n') == std::string::npos);
  return error.substr(path.string().size() + 1);
}

}  // namespace

TEST_CASE("rows are read with times and numbers") {
  const test::TemporaryDirectory folder;
  StampedTable table(folder.write("points",
                                  "\xEF\xBB\xBF#t,x,y,z\r\n\r\n1403715524907143168,1,-2.5,3e2\r\n"
                                  "# pause\n1403715524907143169 0.1\t+2 .5\n"),
                     nanosecond_points);
  REQUIRE(table.next());
  CHECK(table.time() == nanoseconds{1403715524907143168});
  CHECK(table[2] == -2.5);
  CHECK(table.vector(1) == Eigen::Vector3d(1, -2.5, 300));
  REQUIRE(table.next());
  CHECK(table.time() == nanoseconds{1403715524907143169});
  CHECK(table.vector(1) == Eigen::Vector3d(0.1, 2, 0.5));
  CHECK_FALSE(table.next());
}

TEST_CASE("times may be seconds") {
  const test::TemporaryDirectory folder;
  StampedTable table(folder.write("points", "1.305031098665900000e+09 1 2 3"), second_points);
  REQUIRE(table.next());
  CHECK(table.time() == nanoseconds{1305031098665900000});
}

TEST_CASE("the first wrong thing is named with its line") {
  const TableLayout& ns = nanosecond_points;
  CHECK(error_in("", ns) == " no rows, expected points: t,x [m],y [m],z [m]");
  CHECK(error_in("# head\n\n", ns) == "2: no rows, expected points: t,x [m],y [m],z [m]");
  CHECK(error_in("1,1,2,3\n2,1,2\n", ns) == "2: 3 columns, expected 2 or 4 of points: t,x [m],y [m],z [m]");
  CHECK(error_in("1,1,2,3,\n", ns) == "1: 5 columns, expected 2 or 4 of points: t,x [m],y [m],z [m]");
  CHECK(error_in("7\n", ns) == "1: 1 column, expected 2 or 4 of points: t,x [m],y [m],z [m]");
  CHECK(error_in("1,1,2,3\n\n2,1\n", ns) == "3: 2 columns, expected 4 as in the rows before");
  CHECK(error_in("1,1,,3\n", ns) == "1: \"\" is not a number, expected y [m] in column 3");
  CHECK(error_in("1,1,2,3\n2,1,abc,3\n", ns) == "2: \"abc\" is not a number, expected y [m] in column 3");
  CHECK(error_in("1,1,2,3x\n", ns) == "1: \"3x\" is not a number, expected z [m] in column 4");
  CHECK(error_in("# head\n1,1,nan,3\n", ns) == "2: \"nan\" is not a finite number, expected y [m] in column 3");
  CHECK(error_in("1,-inf,2,3\n", ns) == "1: \"-inf\" is not a finite number, expected x [m] in column 2");
  CHECK(error_in("1,1e400,2,3\n", ns) == "1: \"1e400\" is out of the range of a double, expected x [m] in column 2");
  CHECK(error_in("1.5,1,2,3\n", ns) == "1: \"1.5\" is not an integer, expected t in column 1");
  CHECK(error_in("99999999999999999999 1 2 3", ns) ==
        "1: \"99999999999999999999\" does not fit in 64 bits, expected t in column 1");
  CHECK(error_in("5,1\n9,1\n9,1\n", ns) == "3: time 9 follows 9, expected increasing t");
  CHECK(error_in("5,1\n\n-7,1\n", ns) == "3: time -7 follows 5, expected increasing t");

  const TableLayout& s = second_points;
  CHECK(error_in("1.5 1 2\n", s) == "1: 3 columns, expected 4 of points: t x [m] y [m] z [m]");
  CHECK(error_in("1.5 1 2 3\n1.25 1 2 3\n", s) == "2: time 1.25 follows 1.5, expected increasing t");
  CHECK(error_in("1403715524907143168 1 2 3\n", s) ==
        "1: \"1403715524907143168\" does not fit in 64-bit nanoseconds, expected t in column 1");
  CHECK(error_in("x 1 2 3\n", s) == "1: \"x\" is not a number of seconds, expected t in column 1");
  CHECK(error_in("1.5,1,2,3\n", s) ==
        "1: \"1.5,1,2,3\" has commas, expected points separated by blanks: t x [m] y [m] z [m]");
}

TEST_CASE("a row is read alike wherever it stands") {
  // The first row of a file is read field by field, later ones at once if they look as usual.
  const test::TemporaryDirectory folder;
  std::mt19937_64 random(1);
  const auto one_of = [&](const auto& choices) { return choices[random() % choices.size()]; };
  const std::vector<std::string> stamps{"5",
                                        "7",
                                        "007",
                                        "-1",
                                        "+5",
                                        "5.5",
                                        "0",
                                        "",
                                        "x",
                                        "9223372036854775807",
                                        "9223372036854775808",
                                        "18446744073709551621",
                                        "1e1",
                                        "-",
                                        "4"};
  const std::vector<std::string> numbers{"1",   "-2.5", "+3",   ".5",    "5.", "1e3", "-1e-3", "0.1", "1e400", "nan",
                                         "inf", "-inf", "0x10", "1,2",   "",   "-",   "--1",   "1-",  "+-1",   "1e",
                                         "1 2", "#",    "1\r",  "1e+05", "-0", "007", "1;",    "-.",  ".",     "e5"};
  const std::vector<std::string> separators{",", ",", ",", ",", " ", " ", " ", " ", "\t", ", ", " ,", "  ", ""};
  int good = 0, bad = 0;
  for (const TableLayout& layout : {nanosecond_points, second_points}) {
    for (int i = 0; i < 4000; ++i) {
      const bool plain = random() % 2 == 0;  // one separator, and numbers that are some
      const std::string usual = random() % 2 == 0 ? "," : " ";
      std::string row = random() % 8 == 0 ? " " : "";
      row += one_of(stamps);
      for (std::size_t column = 1; column < 4; ++column) {
        row += plain ? usual : one_of(separators);
        row += plain ? numbers[random() % 9] : one_of(numbers);
      }
      row += random() % 8 == 0 ? " \t" : "";
      const auto read = [&](const std::string& text, int rows) {
        StampedTable table(folder.write("points", text), layout);
        std::pair<nanoseconds, std::vector<double>> result;
        try {
          for (bool more = true; rows > 0 && more; --rows) more = table.next();
          result = {table.time(), {table[1], table[2], table[3]}};
        } catch (const std::runtime_error& error) {
          const std::string message = error.what();
          return std::pair(result, message.substr(message.find(": ", message.find("points:"))));
        }
        return std::pair(result, std::string());
      };
      if (row.find_first_not_of(" \t") == std::string::npos || row.find('#') != std::string::npos) continue;
      std::vector<std::string_view> fields;
      const std::string ended = row.ends_with('\r') ? row.substr(0, row.size() - 1) : row;
      split_fields(ended, fields);
      if (fields.size() == 2) continue;  // good only as first row
      const std::string before = layout.separator == ',' ? "-9,1,2,3\n" : "-9 1 2 3\n";
      const auto first = read(row + "\n", 1), second = read(before + row + "\n", 2);
      CAPTURE(row, layout.separator, first.second, second.second);
      REQUIRE(first == second);
      ++(first.second.empty() ? good : bad);
    }
  }
  CHECK(good > 500);
  CHECK(bad > 500);
}

TEST_CASE("the number of rows is guessed from the part that was read") {
  const test::TemporaryDirectory folder;
  StampedTable table(folder.write("points", "1,1,2,3\n2,1,2,3\n3,1,2,3\n4,1,2,3\n"), nanosecond_points);
  CHECK(table.expected_rows(0) == 0);
  for (std::size_t row = 1; row <= 4; ++row) {
    REQUIRE(table.next());
    CHECK(table.expected_rows(row) == 4);
  }
}
