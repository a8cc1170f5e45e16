// SPDX-License-Identifier: MIT
// Compares an estimated trajectory with a reference: absolute and relative errors of position and attitude (ATE and
// RPE) after alignment, with the definitions and statistics of evo, and drift over path lengths as KITTI defines it.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <splinertia/io/file_set.hpp>
#include <stdexcept>
#include <utility>

#include "compare_trajectories/comparison.hpp"
#include "compare_trajectories/options.hpp"
#include "compare_trajectories/output.hpp"
#include "support/common_options.hpp"
#include "support/concat.hpp"
#include "support/inputs.hpp"
#include "support/program.hpp"
#include "support/python_script.hpp"
#include "support/trajectory_input.hpp"

using namespace splinertia;

namespace {

Poses read(const TrajectoryInput& input) {
  TrajectoryFile file = read_trajectory_input(input);
  std::fputs(note_lines(input, file).c_str(), stdout);
  return std::move(file.poses);
}

/// The set for the output files, which are added later. Throws std::invalid_argument if one is an input of the run.
FileSet files_to_write(const Options& o) {
  FileSet files;
  keep_inputs(files, inputs_of(o.reference));
  keep_inputs(files, inputs_of(o.estimate));
  files.expect_not_kept(o.csv, "another path for --csv");
  files.expect_not_kept(o.errors, "another path for --errors");
  files.expect_not_kept(o.plot, "another path for --plot");
  return files;
}

void run(const Options& o) {
  FileSet files = files_to_write(o);
  const Poses reference = read(o.reference), estimate = read(o.estimate);
  const Comparison comparison = compare(reference, estimate, o);
  print(comparison, reference.size(), estimate.size(), o);
  if (!o.errors.empty()) write_errors(o.errors, comparison, files);
  if (!o.csv.empty()) write_table(o.csv, comparison, files);
  files.commit();
  if (o.plot.empty()) return;
  try {
    plot(comparison, o);
  } catch (const ScriptFailed& error) {
    throw OutputLost(error.what());
  }
}

void add_time_options(CLI::App& app, Options& o) {
  const char* const time = "Time";
  app.add_option("--max-difference", o.max_difference, "largest time difference of a pair [s]")
      ->capture_default_str()
      ->group(time);
  app.add_option("--time-offset", o.time_offset, "time to add to the stamps of the estimate [s]")
      ->capture_default_str()
      ->group(time);
  auto* estimated = app.add_flag("--estimate-time-offset", o.estimate_time_offset,
                                 "estimate a time offset from both angular speeds, and add it to --time-offset");
  estimated->group(time);
  app.add_option("--time-offset-range", o.time_offset_range, "range of the search on both sides of --time-offset [s]")
      ->needs(estimated)
      ->capture_default_str()
      ->group(time);
}

void add_alignment_options(CLI::App& app, Options& o) {
  const char* const place = "Alignment";
  app.add_option("--align", o.align,
                 "none; origin: the first poses coincide; yaw: heading about z and translation; se3, sim3: least "
                 "squares of all positions, sim3 with scale")
      ->check(CLI::IsMember(alignments))
      ->capture_default_str()
      ->group(place);
  app.add_option("--align-poses", o.align_poses, "align with this many pairs only, from the first; default: all")
      ->check(CLI::Range(1, 1000000000))
      ->group(place);
}

void add_relative_options(CLI::App& app, Options& o) {
  const char* const relative = "Relative errors";
  app.add_option("--delta", o.delta, "interval of RPE: frames, seconds, or metres of the estimate's path")
      ->capture_default_str()
      ->group(relative);
  app.add_option("--delta-unit", o.unit, "unit of --delta")
      ->check(CLI::IsMember({"frames", "s", "m"}))
      ->capture_default_str()
      ->group(relative);
  app.add_flag("--all-pairs", o.all_pairs, "compute RPE over overlapping intervals, one from every pose")
      ->group(relative);
  app.add_option("--lengths", o.lengths, "lengths of the reference's path to compute drift over [m]")
      ->capture_default_str()
      ->group(relative);
}

void add_file_options(CLI::App& app, Options& o) {
  const char* const files = "Files";
  add_csv_option(app, o.csv, "also write the table to this file, with all digits")->group(files);
  app.add_option("--errors", o.errors, "write the absolute errors of all pairs to this file (csv)")->group(files);
  app.add_option("--plot", o.plot, "draw paths and errors to this .png or .svg file; needs Python with matplotlib")
      ->group(files);
  add_python_option(app, o.python)->group(files);
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("reference", o.reference.file, "reference trajectory: a file or a ROS bag")->required();
  app.add_option("estimate", o.estimate.file, "estimated trajectory: a file or a ROS bag")->required();
  add_trajectory_options(app, o.reference, nullptr, "reference");
  add_trajectory_options(app, o.estimate, nullptr, "estimate");
  add_time_options(app, o);
  add_alignment_options(app, o);
  add_relative_options(app, o);
  add_file_options(app, o);
}

void check(const Options& o) {
  if (o.unit == "frames" && !(o.delta >= 1 && o.delta <= 1e9 && o.delta == std::floor(o.delta))) {
    throw std::invalid_argument(concat("--delta: ", o.delta, ", expected a whole number of frames >= 1"));
  }
  if (!(o.delta > 0) || !std::isfinite(o.delta)) {
    throw std::invalid_argument(concat("--delta: ", o.delta, ' ', o.unit, ", expected a number > 0"));
  }
  if (!(std::abs(o.time_offset) <= 1e9)) {
    throw std::invalid_argument(concat("--time-offset: ", o.time_offset, ", expected -1e9 to 1e9 seconds"));
  }
  if (!(o.time_offset_range > 0 && o.time_offset_range <= 1000)) {
    throw std::invalid_argument(
        concat("--time-offset-range: ", o.time_offset_range, ", expected a number of seconds > 0, up to 1000"));
  }
  if (o.align_poses && (o.align == "none" || o.align == "origin")) {
    throw std::invalid_argument(
        concat("--align-poses: --align ", o.align, " does not use it, expected yaw, se3 or sim3"));
  }
  for (const double length : o.lengths) {
    if (!(length > 0) || !std::isfinite(length)) {
      throw std::invalid_argument(concat("--lengths: ", length, ", expected numbers of metres > 0"));
    }
  }
  if (!o.plot.empty() && o.plot.extension() != ".png" && o.plot.extension() != ".svg") {
    throw std::invalid_argument(concat("--plot: ", o.plot.string(), ", expected a name that ends in .png or .svg"));
  }
}

}  // namespace

const Program this_program{
    "compare_trajectories",
    "Compares two trajectories and prints the statistics of absolute (ATE) and relative (RPE) errors, in metres and "
    "degrees, as evo_ape and evo_rpe define them, and drift over lengths of path, as KITTI does.\n\n"
    "Poses are paired with the nearest in time. --align aligns the estimate with the reference.",
    [](CLI::App& app) -> std::function<void()> {
      static Options options;
      add_options(app, options);
      return [] {
        check(options);
        run(options);
      };
    }};
