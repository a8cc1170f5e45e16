// SPDX-License-Identifier: MIT
#include "../../tools/support/csv_table.hpp"

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>

#include "../io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What `write` writes after "# comment".
std::string written(const auto& write) {
  const test::TemporaryDirectory folder;
  AtomicFile file(folder / "table.csv");
  file.append("# comment\n");
  write(file);
  file.commit();
  return test::content(folder / "table.csv");
}

}  // namespace

TEST_CASE("a table has a line of names and a line for each row") {
  const std::string text = written([](AtomicFile& file) {
    CsvTable table(file, {"name", "axis [m]", "count"});
    table.row("a", 'x', 3u);
    table.row(std::string("\"b, c\""), "", -4L);
  });
  CHECK(text == "# comment\nname,axis [m],count\na,x,3\n\"b, c\",,-4\n");
}

TEST_CASE("cells may be times, flags, real numbers and vectors") {
  const std::string text = written([](AtomicFile& file) {
    CsvTable table(file, {"time", "flag", "real", "x", "y", "z", "a", "b"});
    table.row(nanoseconds(1'403'636'579'758'555'392), true, 0.1, Eigen::Vector3d(1, -2.5, 1e-300),
              std::array{1.0 / 3, 2e22});
  });
  CHECK(text ==
        "# comment\ntime,flag,real,x,y,z,a,b\n1403636579758555392,1,0.1,1,-2.5,1e-300,0.3333333333333333,2e+22\n");
}

TEST_CASE("a cell may be nan or empty where its type says so") {
  const std::string text = written([](AtomicFile& file) {
    CsvTable table(file, {"a", "b", "c", "d"});
    table.row(RealOrNan{not_a_number}, RealOrNan{0.5}, std::optional<RealOrNan>(),
              std::optional<RealOrNan>(RealOrNan{not_a_number}));
  });
  CHECK(text == "# comment\na,b,c,d\nnan,0.5,,nan\n");
  const auto write = [](auto cell) {
    return test::error_of<std::invalid_argument>(
        [&] { (void)written([&](AtomicFile& file) { CsvTable(file, {"a"}).row(cell); }); });
  };
  CHECK(write(not_a_number).find("expected a finite number") != std::string::npos);
  CHECK(write(infinity).find("expected a finite number") != std::string::npos);
  CHECK(write(RealOrNan{infinity}).find("expected a finite number") != std::string::npos);
  CHECK(write(RealOrNan{not_a_number}).empty());
}

TEST_CASE("a row has a cell for each name") {
  const auto error = [](const auto&... cells) {
    return test::error_of<std::logic_error>(
        [&] { (void)written([&](AtomicFile& file) { CsvTable(file, {"a", "b", "c"}).row(cells...); }); });
  };
  CHECK(error(1, 2) == "a row of 2 cells, expected 3");
  CHECK(error(0, Eigen::Vector3d(1, 2, 3)) == "a row of 4 cells, expected 3");
  CHECK(error(Eigen::Vector3d(1, 2, 3)).empty());
}
