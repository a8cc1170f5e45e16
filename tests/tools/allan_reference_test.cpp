// SPDX-License-Identifier: MIT
// Real data: allan/nbs1000_exact.csv allan/stable32_phase_dat allan/stable32_pink
// `allan deviation` against what others have computed: the values that NIST SP 1065 publishes, and where the data is at
// hand (SPLINERTIA_TEST_DATA/allan) tables of Stable32.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using test::TemporaryDirectory;

namespace {

const std::filesystem::path shared = std::filesystem::path(SPLINERTIA_TEST_DATA) / "allan";

struct Row {
  std::int64_t m;
  double tau;
  std::int64_t terms;
  double deviation, lower, upper;
  int alpha;
};

double number(std::string_view text) {
  const Parsed<double> parsed = parse_real(text);
  INFO("number " << text);
  REQUIRE(parsed.problem == nullptr);
  return parsed.value;
}

/// Runs the program and reads the table that it prints, by factor.
std::map<std::int64_t, Row> deviation(const std::string& type, const std::filesystem::path& data,
                                      const std::string& factors, const std::string& options) {
  const TemporaryDirectory folder;
  const auto table = folder / "table.csv";
  const std::string command = "\"" ALLAN_PROGRAM "\" deviation --type " + type + " --factors " + factors + ' ' +
                              options + " \"" + data.string() + "\" > \"" + table.string() + '"';
  INFO(command);
  REQUIRE(std::system(command.c_str()) == 0);
  REQUIRE(test::content(table).starts_with("m,tau,n,deviation,lower,upper,alpha\n"));
  TextFile file(table);
  REQUIRE(file.next());
  std::map<std::int64_t, Row> rows;
  std::vector<std::string_view> fields;
  while (file.next()) {
    split_fields(file.line(), fields);
    REQUIRE(fields.size() == 7);
    const auto integer = [&](std::size_t i) { return static_cast<std::int64_t>(number(fields[i])); };
    rows[integer(0)] = {
        integer(0),        number(fields[1]),           integer(2), number(fields[3]), number(fields[4]),
        number(fields[5]), static_cast<int>(integer(6))};
  }
  return rows;
}

struct Published {
  std::string_view type;
  std::int64_t m;
  double value;
};

/// Writes numbers to a file, checks the published deviations of them.
void check_published(const std::string& numbers, const std::vector<Published>& values, double tolerance) {
  const TemporaryDirectory folder;
  const auto data = folder.write("data.txt", numbers);
  for (const auto& [type, m, value] : values) {
    CAPTURE(type, m);
    const auto rows = deviation(std::string(type), data, std::to_string(m), "--rate 1");
    REQUIRE(rows.size() == 1);
    CHECK(rows.at(m).tau == static_cast<double>(m));
    CHECK_THAT(rows.at(m).deviation, WithinRel(value, tolerance));
  }
}

/// The numbers of the second test set of SP 1065, section 12.4.
std::string thousand_numbers() {
  std::string text;
  std::int64_t n = 1234567890;
  for (int i = 0; i < 1000; ++i, n = 16807 * n % 2147483647) {
    std::array<char, number_text_size> digits{};
    text.append(digits.data(), real_to_chars(digits.data(), static_cast<double>(n) / 2147483647.0));
    text += '\n';
  }
  return text;
}

/// Compares with a table of Stable32: columns m, tau, terms, alpha, lower, deviation, upper; 0 is not computed.
void check_stable32(const std::string& table, const std::string& type, const std::string& data,
                    const std::string& options) {
  std::vector<Row> expected;
  std::string factors;
  TextFile file(shared / table);
  std::vector<std::string_view> fields;
  while (file.next()) {
    split_fields(file.line(), fields);
    REQUIRE(fields.size() == 7);
    const auto integer = [&](std::size_t i) { return static_cast<std::int64_t>(number(fields[i])); };
    expected.push_back({integer(0), number(fields[1]), integer(2), number(fields[5]), number(fields[4]),
                        number(fields[6]), static_cast<int>(integer(3))});
    factors += (factors.empty() ? "" : ",") + std::to_string(integer(0));
  }
  REQUIRE_FALSE(expected.empty());
  const auto rows = deviation(type, shared / data, factors, options);
  REQUIRE(rows.size() == expected.size());
  // Intervals are of the alpha that Stable32 found, by whatever means.
  std::map<int, std::map<std::int64_t, Row>> by_alpha;
  const bool alpha_given = table.find("alpha0") != std::string::npos;
  const std::int64_t samples = rows.begin()->second.terms;  // all but one or two

  double worst = 0, worst_end = 0, worst_first_end = 0;
  int intervals = 0, other_alphas = 0;
  for (const Row& row : expected) {
    CAPTURE(table, row.m);
    const Row& found = rows.at(row.m);
    CHECK(found.terms == row.terms);
    CHECK_THAT(found.tau, WithinRel(row.tau, 5e-5));
    CHECK_THAT(found.deviation, WithinRel(row.deviation, 5e-5));
    worst = std::max(worst, std::abs(found.deviation / row.deviation - 1));
    if (row.alpha != found.alpha && !alpha_given) {
      ++other_alphas;
      CHECK(samples / row.m < 30);  // fewer averages than it takes to tell
    }
    if (row.lower == 0) continue;
    ++intervals;
    if (row.alpha != found.alpha) {
      if (!by_alpha.contains(row.alpha)) {
        by_alpha[row.alpha] =
            deviation(type, shared / data, factors, options + " --alpha " + std::to_string(row.alpha));
      }
    }
    const Row& same = row.alpha == found.alpha ? found : by_alpha[row.alpha].at(row.m);
    // Stable32 takes 2/3 of the terms at m = 1 of white noise, Greenhall and Riley have 0.78 of them.
    const bool first = row.m == 1 && row.alpha == 0;
    for (const auto& [end, value] : {std::pair{same.lower, row.lower}, std::pair{same.upper, row.upper}}) {
      CHECK_THAT(end, WithinRel(value, first ? 3e-3 : 5e-4));
      double& worst_of = first ? worst_first_end : worst_end;
      worst_of = std::max(worst_of, std::abs(end / value - 1));
    }
  }
  std::printf("%-45s %3zu deviations within %.1e, %2d intervals within %.1e (%.1e at m = 1), %d of another alpha\n",
              table.c_str(), expected.size(), worst, intervals, worst_end, worst_first_end, other_alphas);
}

}  // namespace

TEST_CASE("nine numbers of NIST SP 1065, table 30") {
  check_published("892\n809\n823\n798\n671\n644\n883\n903\n677\n",
                  {{"adev", 1, 91.22945},
                   {"adev", 2, 115.8082},
                   {"oadev", 1, 91.22945},
                   {"oadev", 2, 85.95287},
                   {"mdev", 1, 91.22945},
                   {"mdev", 2, 74.78849},
                   {"tdev", 1, 52.67135},
                   {"tdev", 2, 86.35831},
                   {"hdev", 1, 70.80608},
                   {"hdev", 2, 116.7980},
                   {"ohdev", 1, 70.80607},
                   {"ohdev", 2, 85.61487},
                   {"totdev", 1, 91.22945},
                   {"totdev", 2, 93.90379}},
                  1.5e-7);
}

TEST_CASE("a thousand numbers of NIST SP 1065, table 31") {
  check_published(thousand_numbers(),
                  {{"adev", 1, 2.922319e-01},   {"adev", 10, 9.965736e-02},   {"adev", 100, 3.897804e-02},
                   {"oadev", 1, 2.922319e-01},  {"oadev", 10, 9.159953e-02},  {"oadev", 100, 3.241343e-02},
                   {"mdev", 1, 2.922319e-01},   {"mdev", 10, 6.172376e-02},   {"mdev", 100, 2.170921e-02},
                   {"tdev", 1, 1.687202e-01},   {"tdev", 10, 3.563623e-01},   {"tdev", 100, 1.253382e+00},
                   {"hdev", 1, 2.943883e-01},   {"hdev", 10, 1.052754e-01},   {"hdev", 100, 3.910860e-02},
                   {"ohdev", 1, 2.943883e-01},  {"ohdev", 10, 9.581083e-02},  {"ohdev", 100, 3.237638e-02},
                   {"totdev", 1, 2.922319e-01}, {"totdev", 10, 9.134743e-02}, {"totdev", 100, 3.406530e-02}},
                  3e-7);  // half a unit of the last digit of 1.687202e-01
}

TEST_CASE("the thousand numbers in exact arithmetic", "[.real_data]") {
  const TemporaryDirectory folder;
  const auto data = folder.write("data.txt", thousand_numbers());
  double worst = 0;
  int values = 0;
  std::map<std::string, std::map<std::int64_t, Row>> computed;
  TextFile file(shared / "nbs1000_exact.csv");
  REQUIRE(file.next());  // deviation,m,terms,value
  std::vector<std::string_view> fields;
  while (file.next()) {
    split_fields(file.line(), fields);
    REQUIRE(fields.size() == 4);
    const std::string type(fields[0]);
    const auto m = static_cast<std::int64_t>(number(fields[1]));
    if (!computed.contains(type)) computed[type] = deviation(type, data, "all", "--rate 1");
    const Row& row = computed[type].at(m);
    CAPTURE(type, m);
    CHECK(row.terms == static_cast<std::int64_t>(number(fields[2])));
    CHECK_THAT(row.deviation, WithinRel(number(fields[3]), 1e-12));
    worst = std::max(worst, std::abs(row.deviation / number(fields[3]) - 1));
    ++values;
  }
  CHECK(values == 66);
  std::printf("%-45s %3d deviations within %.1e\n", "nbs1000_exact.csv", values, worst);
}

TEST_CASE("tables of Stable32", "[.real_data]") {
  for (const std::string type : {"adev", "hdev", "mdev", "oadev", "ohdev", "tdev", "totdev"}) {
    check_stable32("stable32_phase_dat/phase_dat_" + type + "_octave.txt", type, "stable32_phase_dat/PHASE.DAT",
                   "--phase-data --rate 1");
  }
  for (const std::string type : {"mdev", "oadev", "ohdev", "totdev"}) {
    check_stable32("stable32_phase_dat/phase_dat_" + type + ".txt", type, "stable32_phase_dat/PHASE.DAT",
                   "--phase-data --rate 1");
  }
  const std::string pink = "stable32_pink/pink_frequency.txt";
  for (const std::string type : {"adev", "hdev", "mdev", "oadev", "ohdev", "tdev"}) {
    check_stable32("stable32_pink/" + type + ".txt", type, pink, "--rate-data --rate 0.023809523809523808");
  }
  check_stable32("stable32_pink/totdev_alpha0.txt", "totdev", pink, "--rate 0.023809523809523808");
  check_stable32("stable32_pink/s32_oadev_octave.txt", "oadev", pink, "--rate 1");
}
