// SPDX-License-Identifier: MIT
// Dead reckoning from known states: integrates the IMU samples of a file over windows that each begin at the true state
// of a trajectory file. The error at the end of a window is due to the IMU and the integration scheme.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/euroc.hpp>
#include <splinertia/io/file_set.hpp>
#include <splinertia/splinertia.hpp>
#include <string>
#include <utility>
#include <vector>

#include "dead_reckon/options.hpp"
#include "dead_reckon/setup.hpp"
#include "dead_reckon/truth.hpp"
#include "support/concat.hpp"
#include "support/csv_table.hpp"
#include "support/inputs.hpp"
#include "support/program.hpp"
#include "support/trajectory_input.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// The errors of a scheme over windows of one length.
struct Row {
  double window;                               // s
  std::vector<double> position{}, attitude{};  // errors at the ends, m and deg
  std::size_t gaps = 0;                        // number of gaps that were bridged
  std::size_t skipped = 0;                     // number of windows without a sample or a true state at their end
};

using Samples = std::vector<ImuSample<double, nanoseconds>>;

struct Inputs {
  Samples samples;
  TrueStates truth;
  Setup setup;
};

/// Integrates samples[first] to samples[last] from the true state `start` and adds the errors against `end` to `row`.
template <typename Scheme>
void reckon_window(const Inputs& in, std::size_t first, std::size_t last, const Truth& start, const State& end,
                   const Options& o, Row& row) {
  const Samples& samples = in.samples;
  const Setup& setup = in.setup;
  const ImuBias<double> bias{setup.gyro_bias.value_or(start.bias.gyro), setup.accel_bias.value_or(start.bias.accel)};
  // The IMU is fixed to the body, so both have the same angular velocity.
  State state = imu_state(start.state, setup.mounting, setup.mounting.R_BI * (samples[first].gyro - bias.gyro));
  state.time = samples[first].time;
  const State truth = imu_state(end, setup.mounting, Eigen::Vector3d::Zero());  // its velocity is not used
  const GapOptions<double> gaps{o.longest_gap, o.bridge ? GapPolicy::bridge : GapPolicy::refuse};
  Integrator<Scheme, double, nanoseconds> integrator(state, setup.gravity, gaps);
  try {
    for (std::size_t i = first; i <= last; ++i) {
      integrator.push(
          ImuSample<double, nanoseconds>{samples[i].time, samples[i].gyro - bias.gyro, samples[i].accel - bias.accel});
    }
    integrator.finish();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(concat(o.imu.string(), ": in the window of ", row.window, " s that begins at ",
                                    samples[first].time.count(), ": ", error.what(),
                                    " (--longest-gap, --bridge-gaps; simulate_imu leaves out samples inside holes)"));
  }
  const State& reckoned = integrator.state();
  row.gaps += integrator.gaps();
  row.position.push_back((reckoned.p_WB - truth.p_WB).norm());
  row.attitude.push_back(increment(truth.R_WB, reckoned.R_WB).norm() / units::degree);
}

/// Cuts the samples into consecutive windows and integrates each from the true state at its beginning. A window ends at
/// the sample nearest to its nominal end. It is skipped if its length is then wrong by more than 1 %.
template <typename Scheme>
Row reckon(const Inputs& in, double window, const Options& o) {
  const Samples& samples = in.samples;
  const auto truth_at = [&](nanoseconds time) {
    return at(in.truth, after(time, in.setup.time_offset), o.longest_gap);
  };
  Row row{window};
  std::size_t first = 0;
  while (first + 1 < samples.size()) {
    const nanoseconds begin = samples[first].time, target = after(begin, window);
    const auto start = truth_at(begin);
    if (!start) {
      ++first;
      continue;
    }
    const auto next =
        std::lower_bound(samples.begin() + static_cast<std::ptrdiff_t>(first) + 1, samples.end(), target,
                         [](const ImuSample<double, nanoseconds>& sample, nanoseconds t) { return sample.time < t; });
    auto last = static_cast<std::size_t>(next - samples.begin());
    const bool nearer_before = next == samples.end() || target - samples[last - 1].time < samples[last].time - target;
    if (nearer_before && last - 1 > first) --last;
    if (last == samples.size()) break;
    const bool as_long = std::abs(to_seconds<double>(samples[last].time - target)) <= 0.01 * window;
    if (!as_long && next == samples.end()) break;  // the rest is shorter than a window
    const auto end = truth_at(samples[last].time);
    if (as_long && end) {
      reckon_window<Scheme>(in, first, last, *start, end->state, o, row);
    } else {
      ++row.skipped;
    }
    first = last;
  }
  if (row.position.empty()) {
    const auto span = [](nanoseconds from, nanoseconds to) { return concat(from.count(), " to ", to.count(), " ns"); };
    throw std::runtime_error(concat("no window of ", window, " s in which both files have data: ", o.imu.string(),
                                    " covers ", span(samples.front().time, samples.back().time), ", ",
                                    o.trajectory.file.string(), " covers ",
                                    span(in.truth.rows.front().state.time, in.truth.rows.back().state.time)));
  }
  return row;
}

const std::map<std::string, Row (*)(const Inputs&, double, const Options&)> schemes{
    {"euler", reckon<Euler>},       {"zero-order-hold", reckon<ZeroOrderHold>},
    {"midpoint", reckon<Midpoint>}, {"trapezoid", reckon<Trapezoid>},
    {"rk4", reckon<RungeKutta4>},   {"rk4-double-step", reckon<RungeKutta4DoubleStep>},
    {"magnus4", reckon<Magnus4>}};

/// The quantile at `share` (0 to 1), linearly interpolated between values; 0.5 gives the median.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

std::array<double, 6> figures(const Row& row) {
  return {quantile(row.position, 0.5), quantile(row.position, 0.9), quantile(row.position, 1),
          quantile(row.attitude, 0.5), quantile(row.attitude, 0.9), quantile(row.attitude, 1)};
}

void write_table(const std::filesystem::path& path, const std::vector<Row>& rows, FileSet& files) {
  AtomicFile file(path);
  CsvTable table(file, {"window_s", "runs", "skipped", "gaps", "position_median_m", "position_90_m", "position_max_m",
                        "attitude_median_deg", "attitude_90_deg", "attitude_max_deg"});
  for (const Row& row : rows) {
    table.row(short_number(row.window), row.position.size(), row.skipped, row.gaps, figures(row));
  }
  file.commit(files);
  files.commit();
}

void print_table(const std::vector<Row>& rows) {
  std::puts("                       position error [m]              attitude error [deg]");
  std::puts("window [s]  runs    median        90%        max     median        90%        max");
  for (const Row& row : rows) {
    std::printf("%10g %5zu", row.window, row.position.size());
    for (const double figure : figures(row)) std::printf(" %10.3g", figure);
    std::puts("");
  }
}

void run(const Options& o) {
  FileSet files;
  keep_inputs(files, inputs_of(o.trajectory));
  keep_inputs(files, {o.imu, o.calibration});
  files.expect_not_kept(o.csv, "another path for --csv");
  Inputs in{read_euroc_imu(o.imu), read_truth(o), {}};
  const auto& [samples, truth, used] = in;
  in.setup = setup(o, truth.with_biases);
  std::fputs(truth.notes.c_str(), stdout);
  std::printf("%s: %zu samples over %g s\n%s: %zu %s over %g s\n", o.imu.string().c_str(), samples.size(),
              to_seconds<double>(samples.back().time - samples.front().time), o.trajectory.file.string().c_str(),
              truth.rows.size(), truth.with_velocities ? "states" : "poses with a velocity from their neighbours",
              to_seconds<double>(truth.rows.back().state.time - truth.rows.front().state.time));
  std::vector<Row> rows;
  for (const double window : o.windows) rows.push_back(schemes.at(o.scheme)(in, window, o));

  std::printf("%s, velocities %s, %s\n%s\n", o.scheme.c_str(),
              truth.with_velocities ? "from the trajectory file" : "from its poses", bias_text(used).c_str(),
              mounting_text(used).c_str());
  print_table(rows);
  for (const Row& row : rows) {
    if (row.gaps > 0) {
      std::printf("%g s: gaps longer than %g s that were bridged: %zu\n", row.window, o.longest_gap, row.gaps);
    }
    if (row.skipped > 0) {
      std::printf("%g s: windows skipped without a sample or a true state at their end: %zu\n", row.window,
                  row.skipped);
    }
  }
  if (!o.csv.empty()) write_table(o.csv, rows, files);
}

void check(const Options& o) {
  for (const double window : o.windows) {
    if (!(window > 0 && window <= 1e6)) {
      throw std::invalid_argument(concat("--windows: ", window, ", expected positive numbers of seconds, up to 1e6"));
    }
  }
  if (!(o.longest_gap > 0)) {
    throw std::invalid_argument(concat("--longest-gap: ", o.longest_gap, ", expected a positive number of seconds"));
  }
  const std::pair<const std::optional<Eigen::Vector3d>&, const char*> vectors[] = {
      {o.gyro_bias, "--gyro-bias"}, {o.accel_bias, "--accel-bias"}, {o.lever_arm, "--lever-arm"}};
  for (const auto& [vector, name] : vectors) {
    if (vector && !vector->allFinite()) {
      throw std::invalid_argument(
          concat(name, ": ", vector->x(), ' ', vector->y(), ' ', vector->z(), ", expected finite numbers"));
    }
  }
}

void add_vector(CLI::App& app, const char* name, std::optional<Eigen::Vector3d>& vector, const char* description) {
  app.add_option_function<std::vector<double>>(
         name, [&vector](const std::vector<double>& numbers) { vector.emplace(numbers.data()); }, description)
      ->expected(3)
      ->check(CLI::Number)
      ->type_name("X Y Z");
}

CLI::Option* add_options(CLI::App& app, Options& o) {
  app.add_option("imu", o.imu, "EuRoC IMU samples: ns wx wy wz ax ay az, separated by commas or blanks")->required();
  app.add_option("trajectory", o.trajectory.file,
                 "trajectory of the IMU, or of the body that carries it: a file or a ROS bag")
      ->required();
  add_trajectory_options(app, o.trajectory);
  app.add_option("--scheme", o.scheme, "integration scheme")->check(CLI::IsMember(schemes))->capture_default_str();
  app.add_option("--windows", o.windows, "lengths of the windows [s]")->capture_default_str();
  app.add_option("--calibration", o.calibration,
                 "calibration file of fit_trajectory: biases, gravity, mounting and time offset of the IMU");
  add_vector(app, "--gyro-bias", o.gyro_bias, "gyroscope bias to subtract from the samples [rad/s]");
  add_vector(app, "--accel-bias", o.accel_bias, "accelerometer bias to subtract from the samples [m/s^2]");
  add_vector(app, "--lever-arm", o.lever_arm, "p_BI: position of the IMU in the body of the trajectory [m]");
  app.add_flag("--keep-biases", o.keep_biases, "do not remove the biases of the trajectory or the calibration file")
      ->excludes("--gyro-bias")
      ->excludes("--accel-bias");
  CLI::Option* gravity = add_gravity_option(app, o.gravity);
  app.add_option("--longest-gap", o.longest_gap,
                 "longest gap between samples, and between poses [s]; longer gaps between samples are an error, longer "
                 "gaps between poses have no true states")
      ->capture_default_str();
  app.add_flag("--bridge-gaps", o.bridge, "integrate across longer gaps between samples, and count them");
  add_csv_option(app, o.csv, "also write the table to this file");
  return gravity;
}

}  // namespace

const Program this_program{
    "dead_reckon",
    "Integrates the IMU samples of a file over windows, each from the true state of a trajectory file, and prints "
    "the errors at their ends.\n\n"
    "Velocities are taken from the trajectory file if it has them (EuRoC ground truth with 17 columns), else from "
    "its poses. Biases, gravity and the lever arm are taken from their options, else from the calibration file. "
    "Without either, biases are those of the trajectory file at the beginning of each window, if it has them.",
    [](CLI::App& app) -> std::function<void()> {
      static Options options;
      static const CLI::Option* const gravity = add_options(app, options);
      return [] {
        options.gravity_given = gravity->count() > 0;
        check(options);
        run(options);
      };
    }};
