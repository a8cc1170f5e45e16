// SPDX-License-Identifier: MIT
// From poses to a curve: a trajectory goes in, a spline comes out with its control points, its residuals, what an IMU
// along it would read, and a report that says how far to trust it.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <splinertia/finite.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/require.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fit_trajectory/options.hpp"
#include "fit_trajectory/report.hpp"
#include "support/python_script.hpp"

using namespace splinertia;

namespace {

void plot(const Options& o) {
  try {
    PythonScript(o.python, "plot_fit.py", {o.output.string()}, PythonScript::Output::shared).finish();
    std::printf("wrote fit.png and fit.svg to %s\n", o.output.string().c_str());
  } catch (const ScriptFailed&) {  // the plot is an extra, and why there is none has been said
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "no plot: %s\n", error.what());
  }
}

void run(const Options& o) {
  const TrajectoryInput input{o.trajectory, o.input.format, o.input.topic};
  const TrajectoryFile file = read_trajectory_input(input);
  const Poses& poses = file.poses;
  if (poses.size() < 2) {
    throw std::runtime_error(message(o.trajectory.string(), ": ", poses.size(), " poses, expected at least 2"));
  }
  const double readings = o.rate * seconds<double>(poses.back().time - poses.front().time);
  if (!(readings <= 1e8)) {
    throw std::invalid_argument(message("--rate: ", o.rate, " Hz gives ", readings, " readings, expected at most 1e8"));
  }
  const std::vector<EurocImu> samples = o.imu.empty() ? std::vector<EurocImu>{} : read_euroc_imu(o.imu);
  const FittedTrajectory fitted = o.group == "split" ? fit_trajectory<SO3xR3<double>>(poses, samples, o)
                                                     : fit_trajectory<Sophus::SE3d>(poses, samples, o);
  const std::string text = report(poses, samples.size(), fitted, o);
  const std::vector<std::string> names = write_files(fitted, text, o);
  std::fputs(text.c_str(), stdout);
  std::fputs(note_lines(input, file).c_str(), stdout);
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  }
  std::printf("\nwrote %s to %s\n", list.c_str(), o.output.string().c_str());
  if (!o.no_plot) plot(o);
}

void add_options(CLI::App& app, Options& o) {
  o.python = default_python();
  app.add_option("trajectory", o.trajectory, "trajectory of any format below, or a ROS bag")->required();
  add_trajectory_options(app, o.input);
  app.add_option("--order", o.order, "of the spline: degree + 1")->check(CLI::Range(4, 6))->capture_default_str();
  app.add_option("--group", o.group, "split is SO(3) x R^3, se3 is SE(3)")
      ->check(CLI::IsMember({"split", "se3"}))
      ->capture_default_str();
  app.add_option("-o,--output", o.output,
                 "folder for control_points.csv, knots.csv, residuals.csv, gaps.csv, derived_imu.csv (EuRoC), "
                 "imu_residuals.csv, smoothed.tum, report.txt, fit.png and .svg")
      ->capture_default_str();
  app.add_option("--rate", o.rate, "of derived_imu.csv [Hz]")->capture_default_str();
  app.add_option("--gravity", o.gravity,
                 "acceleration of free fall in the world [m/s^2]: x y z, or its amount along -z")
      ->expected(1, 3)
      ->check(CLI::Number)
      ->capture_default_str();
  app.add_flag("--no-plot", o.no_plot, "no fit.png and .svg, which need Python with matplotlib");
  app.add_option("--python", o.python, "for the plot; default: $SPLINERTIA_PYTHON or python3")->capture_default_str();

  const char* const knots = "Knots, one of";
  app.add_option("--knot-interval", o.knot_interval,
                 "so far apart [s]; default: 0.05, or where poses are sparse two of their intervals")
      ->group(knots);
  app.add_option("--goal-position", o.goal_position,
                 "the furthest apart with at most these residuals, rms of each axis [m]")
      ->group(knots);
  app.add_option("--goal-rotation", o.goal_rotation, "goes with it [rad]")->group(knots);
  app.add_flag("--adaptive", o.adaptive, "closer where the motion asks for it, to meet these goals everywhere")
      ->group(knots);
  app.add_flag("--cross-validate", o.cross_validate, "as they predict poses best that were left out")->group(knots);
  app.add_flag("--interpolate", o.interpolate, "at the poses: the curve goes through every one")->group(knots);

  const char* const fit = "What the fit believes";
  app.add_option("--loss", o.loss, "of residuals")
      ->check(CLI::IsMember({"squares", "huber", "cauchy"}))
      ->capture_default_str()
      ->group(fit);
  auto* position = app.add_option("--deviation-position", o.position_deviation,
                                  "standard deviation of a pose's position [m]; default: found in the residuals");
  auto* rotation = app.add_option("--deviation-rotation", o.rotation_deviation, "and of its rotation [rad]");
  position->needs(rotation)->group(fit);
  rotation->needs(position)->group(fit);
  auto* smooth_position = app.add_option("--smooth-position", o.position_density,
                                         "as if the derivative were white noise of this density [m/s^2/sqrt(Hz)], or "
                                         "[m/s^3/sqrt(Hz)]; for smoothness, or knots closer than poses");
  auto* smooth_rotation =
      app.add_option("--smooth-rotation", o.rotation_density, "and [rad/s^2/sqrt(Hz)], or [rad/s^3/sqrt(Hz)]");
  smooth_position->needs(smooth_rotation)->needs(position)->group(fit);
  smooth_rotation->needs(smooth_position)->group(fit);
  app.add_option("--smooth-derivative", o.smooth_derivative, "2: acceleration, 3: jerk")
      ->check(CLI::Range(2, 3))
      ->needs(smooth_position)
      ->capture_default_str()
      ->group(fit);
  app.add_option("--outlier-limit", o.outlier_limit, "standard deviations from which on a pose is reported")
      ->capture_default_str()
      ->group(fit);
  app.add_option("--most-iterations", o.most_iterations, "linear systems to solve")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->group(fit);

  const char* const imu_group = "An IMU that was there";
  auto* imu = app.add_option("--imu", o.imu, "its samples: EuRoC imu csv, commas or blanks; calibrates it");
  imu->group(imu_group);
  auto* gyro = app.add_option("--gyro-deviation", o.gyro_deviation,
                              "standard deviation of a sample [rad/s]; default: found in the residuals");
  auto* accel = app.add_option("--accel-deviation", o.accel_deviation, "and [m/s^2]");
  gyro->needs(accel)->needs(imu)->group(imu_group);
  accel->needs(gyro)->group(imu_group);
  app.add_flag("--estimate-lever-arm", o.estimate_lever_arm, "where it is in the body")->needs(imu)->group(imu_group);
  app.add_flag("--estimate-time-offset", o.estimate_time_offset, "between its clock and the trajectory's")
      ->needs(imu)
      ->group(imu_group);
  app.add_flag("--fit-imu", o.fit_imu, "fit the curve to its samples, too; needs their deviations")
      ->needs(imu)
      ->needs(gyro)
      ->group(imu_group);
}

void check(const Options& o) {
  if (o.goal_position.has_value() != o.goal_rotation.has_value()) {
    throw std::invalid_argument("--goal-position and --goal-rotation: expected both or none");
  }
  if (o.adaptive && !o.goal_position) {
    throw std::invalid_argument(
        "--adaptive: expected --goal-position and --goal-rotation, which the knots have to meet");
  }
  const std::pair<bool, const char*> ways[] = {{o.knot_interval.has_value(), "--knot-interval"},
                                               {o.goal_position && !o.adaptive, "--goal-position"},
                                               {o.adaptive, "--adaptive"},
                                               {o.cross_validate, "--cross-validate"},
                                               {o.interpolate, "--interpolate"}};
  const char* chosen = nullptr;
  for (const auto& [given, name] : ways) {
    if (!given) continue;
    if (chosen) throw std::invalid_argument(message(chosen, " and ", name, ": expected one way to place knots"));
    chosen = name;
  }
  if (o.interpolate && o.order % 2 != 0) {
    throw std::invalid_argument(message("--interpolate: order ", o.order, ", expected an even one"));
  }
  if (o.interpolate && (o.position_deviation || o.position_density)) {
    throw std::invalid_argument("--interpolate: expected no deviations and no smoothness, the curve takes every pose");
  }
  if (o.fit_imu && (o.adaptive || o.interpolate)) {
    throw std::invalid_argument(message("--fit-imu and ", chosen, ": expected uniform knots"));
  }
  if (o.knot_interval && !(*o.knot_interval >= 1e-6 && *o.knot_interval <= 1e6)) {
    throw std::invalid_argument(message("--knot-interval: ", *o.knot_interval, ", expected 1e-6 to 1e6 seconds"));
  }
  const std::pair<std::optional<double>, const char*> numbers[] = {{o.goal_position, "--goal-position"},
                                                                   {o.goal_rotation, "--goal-rotation"},
                                                                   {o.position_deviation, "--deviation-position"},
                                                                   {o.rotation_deviation, "--deviation-rotation"},
                                                                   {o.position_density, "--smooth-position"},
                                                                   {o.rotation_density, "--smooth-rotation"},
                                                                   {o.gyro_deviation, "--gyro-deviation"},
                                                                   {o.accel_deviation, "--accel-deviation"},
                                                                   {o.rate, "--rate"},
                                                                   {o.outlier_limit, "--outlier-limit"}};
  for (const auto& [number, name] : numbers) {
    if (number && !(*number > 0 && is_finite(*number))) {
      throw std::invalid_argument(message(name, ": ", *number, ", expected a finite number > 0"));
    }
  }
  if (o.gravity.size() == 2) throw std::invalid_argument("--gravity: 2 numbers, expected 1 or 3");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Fits a spline to the poses of a trajectory: smooth, with velocities and accelerations that mean something,\n"
      "and says how far it is from the poses, which of them lie off, and where nothing holds it."};
  Options options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
    check(options);
    run(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fit_trajectory: %s\n", error.what());
    return 2;
  }
  return 0;
}
