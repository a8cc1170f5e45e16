// SPDX-License-Identifier: MIT
// Simulates an IMU along a trajectory and integrates its samples back. The result shows the errors that the noise and
// the integration scheme cause.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <splinertia/imu/describe.hpp>
#include <splinertia/imu/ideal_imu.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/motion/circle.hpp>
#include <splinertia/motion/coning.hpp>
#include <splinertia/motion/constant_twist.hpp>
#include <splinertia/motion/ellipse.hpp>
#include <splinertia/time.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulate_imu/dead_reckoning.hpp"
#include "simulate_imu/options.hpp"
#include "simulate_imu/output.hpp"
#include "support/any_trajectory.hpp"
#include "support/concat.hpp"
#include "support/csv_table.hpp"
#include "support/error_yaml.hpp"
#include "support/extremes.hpp"
#include "support/fit_report.hpp"
#include "support/fitted_trajectory.hpp"
#include "support/formatted.hpp"
#include "support/holes.hpp"
#include "support/program.hpp"
#include "support/progress.hpp"
#include "support/sampling_rate.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// Simulates the samples along a trajectory, writes the files and prints the errors of integrating the samples back.
class Run {
 public:
  Run(const AnyTrajectory& truth, const std::vector<Hole>& holes, const Options& o, const Sensor& sensor,
      OutputFolder& folder)
      : truth_(truth),
        holes_(holes),
        options_(o),
        output_(o, sensor, holes, folder),
        ideal_("ideal", o.gravity.vector),
        noisy_("noisy", o.gravity.vector),
        in_hole_(holes.size()) {}

  void follow(const auto& readings) {
    samples_ = readings.size();
    Progress progress(samples_);
    auto reading = readings.begin();
    for (std::size_t i = 0; i < samples_; ++i) {
      progress.advance();
      const nanoseconds time = readings.time(i);
      const bool arrived = reading != readings.end() && reading->true_time == time;
      if (enter(time)) {
        const auto motion = truth_.evaluate<2>(time);
        const TrueState state = nav_state(motion, time);
        const auto measured = ideal_imu(motion, options_.gravity.vector);
        ideal_.add(ImuSample<double, nanoseconds>{time, measured.gyro, measured.accel}, state);
        if (arrived) {
          noisy_.add(*reading, state);
          output_.append(*reading, state);
        }
        ++(arrived ? written_ : dropped_);
      }
      if (arrived) ++reading;
    }
  }

  void finish() {
    if (written_ == 0) {
      throw std::runtime_error(concat("none of ", samples_, " samples is left: ", dropped_, " dropped, ", left_out(),
                                      " in holes without poses (--keep-holes keeps these)"));
    }
    if (AtomicFile* file = output_.table()) write(*file);
    const std::string names = output_.commit();
    if (dropped_ > 0) std::printf("%zu sample%s dropped\n", dropped_, dropped_ == 1 ? " was" : "s were");
    print_holes();
    std::printf("wrote %s to %s\n", names.c_str(), options_.output.string().c_str());
    print_table();
  }

 private:
  /// Whether the sample at this time is kept. After samples that are left out the integration restarts from the truth.
  bool enter(nanoseconds time) {
    const auto hole = hole_at(holes_, time);
    if (hole) ++in_hole_[*hole];
    if (hole && !options_.keep_holes) {
      ideal_.restart();
      noisy_.restart();
      return false;
    }
    if (hole && hole != last_hole_) output_.mark(holes_[*hole]);
    last_hole_ = hole;
    return true;
  }

  [[nodiscard]] std::size_t left_out() const {
    std::size_t count = 0;
    if (options_.keep_holes) return count;
    for (const std::size_t samples : in_hole_) count += samples;
    return count;
  }

  void print_holes() const {
    if (holes_.empty()) return;
    std::vector<std::string> counts;
    for (const std::size_t samples : in_hole_) {
      counts.push_back(formatted("%zu sample%s", samples, samples == 1 ? "" : "s"));
    }
    std::puts(options_.keep_holes ? "samples in holes are invented; comments in imu.csv mark them:"
                                  : "samples in holes are left out of all files; --keep-holes keeps them:");
    for (const std::string& line : hole_lines(holes_, truth_.start(), 20, counts)) std::printf("  %s\n", line.c_str());
  }

  void print_table() const {
    std::printf("\nIntegrated back from the true initial state%s:\n\n",
                left_out() > 0 ? ", and from the truth again after each hole" : "");
    std::puts("                     position error [m]              attitude error [deg]");
    std::puts("IMU    scheme         rms        max        end        rms        max        end");
    ideal_.print();
    noisy_.print();
  }

  void write(AtomicFile& file) const {
    CsvTable table(file, {"imu", "scheme", "position_rms_m", "position_max_m", "position_end_m", "attitude_rms_deg",
                          "attitude_max_deg", "attitude_end_deg"});
    ideal_.write(table);
    noisy_.write(table);
  }

  const AnyTrajectory& truth_;
  const std::vector<Hole>& holes_;
  const Options& options_;
  Output output_;
  DeadReckoning ideal_, noisy_;
  std::vector<std::size_t> in_hole_;  // samples
  std::optional<std::size_t> last_hole_{};
  std::size_t samples_ = 0, written_ = 0, dropped_ = 0;
};

void simulate_along(const AnyTrajectory& truth, const std::vector<Hole>& holes, const Options& o, const Sensor& sensor,
                    OutputFolder& folder) {
  check_sampling_rate(sensor.rate, to_seconds<double>(truth.end() - truth.start()));
  const auto readings =
      simulate(truth, sensor.errors, {.rate = sensor.rate, .seed = o.seed, .gravity = o.gravity.vector});
  const nanoseconds duration = readings.time(readings.size() - 1) - readings.time(0);
  std::printf("IMU: %zu samples at %g Hz, %g s, seed %llu\n", readings.size(), sensor.rate,
              to_seconds<double>(duration), static_cast<unsigned long long>(o.seed));
  std::fputs(describe(sensor.errors).c_str(), stdout);
  Run run(truth, holes, o, sensor, folder);
  run.follow(readings);
  run.finish();
}

void simulate_file(const Options& o) {
  const Sensor sensor = sensor_of(o);
  OutputFolder folder = output_folder(o, sensor);
  const FitInput input = read_fit_input(o.input);
  const FittedTrajectory fitted = fit_trajectory(input, o.fit, nullptr);
  const Extremes found = extremes(input.poses, fitted, o.gravity.vector, sensor.rate);
  std::printf("%s\n", fit_report(input, fitted, o.fit, nullptr, found).c_str());
  if (const std::string reason = not_converged(fitted, o.fit); !reason.empty() && !o.fit.accept) {
    throw NotAccepted(reason + "; nothing is written (--accept writes the result anyway)");
  }
  simulate_along(fitted.curve, fitted.holes, o, sensor, folder);
}

void simulate_analytic(const Options& o) {
  const Sensor sensor = sensor_of(o);
  OutputFolder folder = output_folder(o, sensor);
  const auto motion = [&](const auto& exact) {
    return AnyTrajectory(exact, nanoseconds(0), to_nanoseconds(o.duration));
  };
  std::printf("%s: analytic motion, exact samples\n", o.motion.c_str());
  const AnyTrajectory truth = o.motion == "ellipse"  ? motion(Ellipse<>{})
                              : o.motion == "circle" ? motion(Circle<>{.radius = 5, .rate = 0.4, .height = 1})
                              : o.motion == "coning" ? motion(Coning<>{.angle = 0.1, .rate = 10})
                                                     : motion(at_rest(SO3xR3<double>{}));
  simulate_along(truth, {}, o, sensor, folder);
}

}  // namespace

const Program this_program{
    "simulate_imu",
    "Simulates an IMU along a trajectory, writes its samples and the ground truth, and integrates them back.\n\n"
    "A smooth spline is fitted to the poses of a file, from the first to the last. Its residuals, the outliers,\n"
    "and the holes without poses are printed. The ground truth written is that of the spline.",
    [](CLI::App& app) -> std::function<void()> {
      static Options options;
      add_options(app, options);
      return [] {
        if (options.help_errors) {
          std::fputs(error_yaml_help().c_str(), stdout);
          return;
        }
        check(options);
        options.input.file.empty() ? simulate_analytic(options) : simulate_file(options);
      };
    }};
