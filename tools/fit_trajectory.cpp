// SPDX-License-Identifier: MIT
// Fits a spline to the poses of a trajectory. Writes its control points, its residuals, the readings of an ideal IMU
// along it, and a report that says how far to trust it.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "fit_trajectory/files.hpp"
#include "fit_trajectory/options.hpp"
#include "support/concat.hpp"
#include "support/extremes.hpp"
#include "support/fit_report.hpp"
#include "support/formatted.hpp"
#include "support/inputs.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"
#include "support/progress.hpp"
#include "support/python_script.hpp"
#include "support/sampling_rate.hpp"
#include "support/trajectory_input.hpp"

using namespace splinertia;

namespace {

/// Throws std::invalid_argument if an output file is also an input of the run. Files that are not always written are
/// checked again when they are begun.
OutputFolder output_folder(const Options& o) {
  Inputs inputs = inputs_of(o.input);
  inputs.push_back(o.imu.file);
  OutputFolder folder(o.output, "fit_trajectory", inputs);
  folder.expect_no_inputs(
      {"control_points.csv", "residuals.csv", "gaps.csv", "report.txt", "derived_imu.csv", "smoothed.tum"});
  if (!o.imu.file.empty()) folder.expect_no_inputs({"imu_residuals.csv", "calibration.yaml"});
  if (!o.no_plot) folder.expect_pictures("fit");
  return folder;
}

void run(Options& o) {
  OutputFolder folder = output_folder(o);
  const FitInput input = read_fit_input(o.input);
  if (!input.poses.empty()) {
    check_sampling_rate(o.rate, to_seconds<double>(input.poses.back().time - input.poses.front().time));
  }
  const FitImu* imu = o.imu.file.empty() ? nullptr : &o.imu;
  if (imu) {
    o.imu.samples = read_euroc_imu(o.imu.file);
    o.imu.gravity = o.gravity.vector;
  }
  const FittedTrajectory fitted = fit_trajectory(input, o.fit, imu);
  const Extremes found = extremes(input.poses, fitted, o.gravity.vector, o.rate);
  const std::string report = fit_report(input, fitted, o.fit, imu, found);
  if (const std::string reason = not_converged(fitted, o.fit); !reason.empty() && !o.fit.accept) {
    std::fputs(report.c_str(), stdout);
    throw NotAccepted(reason + "; nothing is written (--accept writes the result anyway)");
  }
  const WrittenFiles written = write_files(fitted, report, o, folder);
  std::fputs(report.c_str(), stdout);
  std::printf("\n%swrote %s to %s\n", written.note.c_str(), written.names.c_str(), o.output.string().c_str());
  if (!o.no_plot) draw_plot(o.python, "fit", o.output);
}

void add_imu_options(CLI::App& app, FitImu& imu) {
  const char* const group = "Recorded IMU";
  auto* file = app.add_option("--imu", imu.file, "samples of an IMU to calibrate: EuRoC imu csv, commas or blanks");
  file->group(group);
  auto* gyro = app.add_option("--gyro-deviation", imu.gyro_deviation,
                              "standard deviation of a gyroscope sample [rad/s]; default: found in the residuals");
  auto* accel =
      app.add_option("--accel-deviation", imu.accel_deviation, "standard deviation of an accelerometer sample [m/s^2]");
  gyro->needs(accel)->needs(file)->group(group);
  accel->needs(gyro)->group(group);
  app.add_flag("--estimate-lever-arm", imu.estimate_lever_arm, "estimate the position of the IMU in the body")
      ->needs(file)
      ->group(group);
  app.add_flag("--estimate-time-offset", imu.estimate_time_offset,
               "estimate the offset between the clocks of the IMU and the trajectory")
      ->needs(file)
      ->group(group);
  app.add_flag("--fit-imu", imu.fit_together, "also fit the curve to the samples of the IMU")
      ->needs(file)
      ->needs(gyro)
      ->group(group);
}

void add_options(CLI::App& app, Options& o) {
  auto* trajectory = app.add_option("trajectory", o.input.file, "trajectory of any format below, or a ROS bag");
  trajectory->required();
  add_output_option(
      app, o.output,
      "folder for control_points.csv (exists only if all files are complete), knots.csv, residuals.csv, gaps.csv, "
      "derived_imu.csv (EuRoC), imu_residuals.csv, calibration.yaml, smoothed.tum, report.txt, fit.png and .svg");
  add_rate_option(app, o.rate, "sampling rate of derived_imu.csv [Hz]");
  app.add_flag("--keep-holes", o.keep_holes, "keep the readings inside holes without poses, which are invented");
  add_gravity_option(app, o.gravity);
  add_no_plot_option(app, o.no_plot, "fit");
  add_python_option(app, o.python);
  add_trajectory_options(app, o.input);
  add_fit_options(app, o.fit, trajectory);
  add_imu_options(app, o.imu);
}

void check(const Options& o) {
  check(o.fit);
  if (o.imu.fit_together && (o.fit.adaptive || o.fit.interpolate)) {
    throw std::invalid_argument(
        concat("--fit-imu and ", o.fit.adaptive ? "--adaptive" : "--interpolate", ": expected uniform knots"));
  }
  check_positive("--gyro-deviation", o.imu.gyro_deviation);
  check_positive("--accel-deviation", o.imu.accel_deviation);
  check_sampling_rate(o.rate, 0);
}

}  // namespace

const Program this_program{
    "fit_trajectory",
    "Fits a smooth spline with usable velocities and accelerations to the poses of a trajectory.\n"
    "Reports its residuals, the outliers among the poses, and the holes in which no poses measure it.",
    [](CLI::App& app) -> std::function<void()> {
      static Options options;
      add_options(app, options);
      return [] {
        check(options);
        run(options);
      };
    }};
