// SPDX-License-Identifier: MIT
/// The library against the reference values in this folder, and the reader and the grading that this rests on.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "golden_checks.hpp"
#include "support/catch.hpp"

namespace {

/// A table in a temporary file.
class TemporaryTable {
 public:
  explicit TemporaryTable(const std::string& content)
      : path_(std::filesystem::temp_directory_path() / "splinertia_golden_test.csv") {
    std::ofstream(path_) << content;
  }
  ~TemporaryTable() { std::filesystem::remove(path_); }
  TemporaryTable(const TemporaryTable&) = delete;
  TemporaryTable& operator=(const TemporaryTable&) = delete;

  [[nodiscard]] golden::Table read() const { return golden::Table(path_); }
  [[nodiscard]] std::string message() const {
    try {
      (void)read()[0].inputs<double>("x");
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path path_;
};

template <typename Scalar>
[[nodiscard]] double share_of_limit(const golden::Row& row, golden::Numbers got, golden::Measure measure = {}) {
  golden::Report report;
  golden::Grader<Scalar>(report, row).check("x", got, {1, 2}, measure);
  return report.lines().at(0).worst_share;
}

}  // namespace

TEST_CASE("all reference values are met", "[golden]") {
  const auto report = golden::check_folder(SPLINERTIA_GOLDEN_DIR);
  std::ostringstream failures;
  report.print_failures(failures);
  INFO(failures.str());
  CHECK(report.lines().size() > 100);
  CHECK(report.passed());
}

TEST_CASE("inputs are doubles before they are anything else, outputs keep their digits", "[golden]") {
  const TemporaryTable file("id,class,x,y\n0,a;b,0.1 -2e-300 3,\r\n1,,0.1,1\n");
  const auto table = file.read();
  REQUIRE(table.size() == 2);
  CHECK(table[0].text("class") == "a;b");
  CHECK(table[0].inputs<long double>("x") == std::vector<long double>{0.1, -2e-300, 3});
  CHECK(table[0].inputs<float>("x").at(0) == static_cast<float>(0.1));
  CHECK(table[0].outputs("x") == std::vector<long double>{0.1L, -2e-300L, 3});
  CHECK(table[0].outputs("y").empty());
  CHECK_FALSE(table[0].flag("y"));
  CHECK(table[1].flag("y"));
  CHECK_FALSE(table[1].flag("z"));
}

TEST_CASE("what is wrong with a table is said with its place", "[golden]") {
  CHECK_THROWS_AS(golden::Table("no/such/file.csv"), std::runtime_error);
  CHECK_THROWS_AS(golden::check_folder("no/such/folder"), std::runtime_error);
  CHECK(TemporaryTable("id,x\n0,1 two\n").message().find("csv:2: column x: 'two' is not a number") !=
        std::string::npos);
  CHECK(TemporaryTable("id,y\n0,1\n").message().find("no column x") != std::string::npos);
  CHECK(TemporaryTable("id,x\n0,1\n1\n").message().find("csv:3: 1 cells where the header has 2") != std::string::npos);
  CHECK(TemporaryTable("").message().find("empty") != std::string::npos);
}

TEST_CASE("errors are counted in eps of the scalar's grade", "[golden]") {
  const TemporaryTable file("id,f32\n0,0\n1,1\n");
  const auto table = file.read();
  const long double eps = std::numeric_limits<double>::epsilon();
  CHECK(share_of_limit<double>(table[0], {1, 2}) == 0);
  CHECK(share_of_limit<double>(table[0], {1, 2 + 8 * eps}) == 1);  // C = 4 of |gold| = 2
  CHECK(share_of_limit<double>(table[0], {1 + 8 * eps, 2}) == 1);  // the largest component counts
  CHECK(share_of_limit<double>(table[0], {1, 2 + 8 * eps}, {.scale = 2}) == 0.5);
  CHECK(share_of_limit<double>(table[0], {1, 2 + 8 * eps}, {.cond = 100}) == 1);  // double has grade A
  CHECK(share_of_limit<double>(table[0], {1, std::nan("")}) > 1);
  const long double float_eps = std::numeric_limits<float>::epsilon();
  CHECK(share_of_limit<float>(table[0], {1, 2 + 8 * float_eps}, {.cond = 2}) == 0.5);  // grade B
  CHECK(share_of_limit<float>(table[1], {1, 2 + 8 * float_eps}, {.cond = 2}) == 1);    // all floats: grade A
  CHECK_THROWS(share_of_limit<double>(table[0], {1}));
}
