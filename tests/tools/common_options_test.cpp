// SPDX-License-Identifier: MIT
#include "../../tools/support/common_options.hpp"

#include <CLI/CLI.hpp>
#include <limits>
#include <string>
#include <vector>

#include "../io/temporary_directory.hpp"
#include "support/catch.hpp"

using splinertia::test::error_of;

namespace {

/// A program with all of them.
struct Program {
  CLI::App app;
  std::filesystem::path output = "here", csv;
  bool no_plot = false;
  std::string python;
  double rate = 200;
  std::optional<double> other_rate;
  std::uint64_t seed = 4711;
  GravityOption gravity;

  Program() {
    add_output_option(app, output, "folder for files");
    add_csv_option(app, csv, "also write the table");
    add_no_plot_option(app, no_plot, "picture");
    add_python_option(app, python);
    add_rate_option(app, rate);
    add_rate_option(*app.add_subcommand("other"), other_rate, "another rate");
    add_seed_option(app, seed, "seed of the noise");
    add_gravity_option(app, gravity);
  }
  void parse(std::vector<std::string> arguments) {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes the last one first
  }
};

std::string refusal(const std::vector<std::string>& arguments) {
  return error_of<CLI::ParseError>([&] { Program().parse(arguments); });
}

}  // namespace

TEST_CASE("without options the values stay") {
  Program program;
  program.parse({});
  CHECK(program.output == "here");
  CHECK(program.csv.empty());
  CHECK_FALSE(program.no_plot);
  CHECK_FALSE(program.python.empty());
  CHECK(program.rate == 200);
  CHECK(program.seed == 4711);
  CHECK(program.gravity.vector == Eigen::Vector3d(0, 0, -9.80665));
}

TEST_CASE("options set the values") {
  Program program;
  program.parse({"-o", "a b", "--csv", "t.csv", "--no-plot", "--python", "pypy", "--rate", "12.5", "--seed",
                 "18446744073709551615", "--gravity", "1", "-2", "3", "other", "--rate", "4"});
  CHECK(program.output == "a b");
  CHECK(program.csv == "t.csv");
  CHECK(program.no_plot);
  CHECK(program.python == "pypy");
  CHECK(program.rate == 12.5);
  CHECK(program.other_rate == 4.0);
  CHECK(program.seed == std::numeric_limits<std::uint64_t>::max());
  CHECK(program.gravity.vector == Eigen::Vector3d(1, -2, 3));
  program.parse({"--gravity", "1.62"});
  CHECK(program.gravity.vector == Eigen::Vector3d(0, 0, -1.62));
}

TEST_CASE("seeds and gravities that nobody means are refused") {
  for (const std::string seed : {"-1", "1.5", "18446744073709551616", "7x"}) {
    CAPTURE(seed);
    CHECK(refusal({"--seed=" + seed}) ==
          "--seed: " + seed + ", expected a whole number from 0 to 18446744073709551615");
  }
  CHECK(refusal({"--gravity=-9.81"}) ==
        "--gravity: -9.81, expected a magnitude >= 0, which acts along -z, or a vector x y z");
  CHECK(refusal({"--gravity", "1", "2"}) == "--gravity: 2 numbers, expected 1 or 3");
  CHECK(refusal({"--gravity", "0", "0", "inf"}) == "--gravity: inf, expected finite numbers");
}

TEST_CASE("the help has the defaults") {
  const std::string help = Program().app.help();
  for (const char* text : {"here", "do not draw picture.png and .svg", "Python interpreter for the plot;", "200",
                           "4711", "0 0 -9.80665"}) {
    CAPTURE(text);
    CHECK(help.find(text) != std::string::npos);
  }
}
