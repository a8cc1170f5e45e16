// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <array>
#include <chrono>
#include <limits>
#include <splinertia/io/stamped_table_writer.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;
using test::content;
using test::error_of;

namespace {

constexpr std::array<std::string_view, 4> columns{"t", "x", "y", "z"};
constexpr TableLayout commas{.format = "points",
                             .columns = columns,
                             .fewest_columns = 4,
                             .stamp = TableLayout::Stamp::nanoseconds,
                             .separator = ',',
                             .header = true};
constexpr TableLayout blanks{.format = "points",
                             .columns = columns,
                             .fewest_columns = 4,
                             .stamp = TableLayout::Stamp::seconds,
                             .separator = ' ',
                             .header = false};
const Eigen::Vector3d point{1, -0.5, 0.125};

}  // namespace

TEST_CASE("rows are written as the layout says") {
  const test::TemporaryDirectory folder;
  for (const TableLayout& layout : {commas, blanks}) {
    StampedTableWriter table(folder / "points", layout);
    table.append(nanoseconds{1'500'000'000}, point);
    table.append(nanoseconds{2'000'000'001}, Eigen::Vector2d{4, 5}, Eigen::Matrix<double, 1, 1>{6.0});
    table.commit();
    CHECK(content(folder / "points") == (layout.header ? "#t,x,y,z\n1500000000,1,-0.5,0.125\n2000000001,4,5,6\n"
                                                       : "1.500000000 1 -0.5 0.125\n2.000000001 4 5 6\n"));
  }
}

TEST_CASE("a row that comes after the commit is refused, not lost") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "points";
  StampedTableWriter alone(path, commas), of_a_set(path, commas);
  FileSet set;
  alone.append(nanoseconds{1}, point);
  alone.commit();
  of_a_set.append(nanoseconds{1}, point);
  of_a_set.commit(set);
  for (StampedTableWriter* table : {&alone, &of_a_set}) {
    CHECK(error_of<std::runtime_error>([&] { table->append(nanoseconds{2}, point); }) ==
          path.string() + ": was committed or abandoned before");
    CHECK(error_of<std::runtime_error>([&] { table->comment("of nothing"); }) ==
          path.string() + ": was committed or abandoned before");
  }
}

TEST_CASE("what no reader would take is not written") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "points";
  CHECK(error_of<std::invalid_argument>([&] { StampedTableWriter(path, commas).commit(); }) ==
        path.string() + ": no rows to write");
  {
    StampedTableWriter table(path, commas);
    table.append(nanoseconds{7}, point);
    CHECK(error_of<std::invalid_argument>([&] { table.append(nanoseconds{7}, point); }) ==
          path.string() + ": time 7 ns follows 7 ns, expected increasing times");
    CHECK_THROWS_AS(table.commit(), std::runtime_error);
  }
  {
    StampedTableWriter table(path, commas);
    const Eigen::Vector3d bad{0, std::numeric_limits<double>::quiet_NaN(), 0};
    CHECK_THROWS_AS(table.append(nanoseconds{7}, bad), std::invalid_argument);
    CHECK_THROWS_AS(table.commit(), std::runtime_error);
  }
  CHECK(folder.files() == 0);
}
