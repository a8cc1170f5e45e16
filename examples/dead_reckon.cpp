// SPDX-License-Identifier: MIT
// Dead reckoning from a known state: the IMU samples of a file are integrated over windows that each begin at the true
// state of a trajectory file, and the error at the end of each is what the IMU and the scheme leave over.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/euroc.hpp>
#include <splinertia/io/trajectory.hpp>
#include <splinertia/splinertia.hpp>
#include <string>
#include <vector>

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

struct Options {
  std::filesystem::path imu, trajectory, csv;
  std::string scheme = "midpoint";
  std::vector<double> windows{1, 5, 10};
  std::vector<double> gravity{0, 0, -9.80665};
  double longest_gap = 0.1;
  bool bridge = false, keep_biases = false;

  Eigen::Vector3d gravity_vector() const {
    return gravity.size() == 1 ? Eigen::Vector3d(0, 0, -gravity[0]) : Eigen::Vector3d(gravity.data());
  }
};

using State = NavState<double, nanoseconds>;

/// What is known to be true at a time.
struct Truth {
  State state;
  ImuBias<double> bias;
};

/// What a trajectory file says, in the order of time.
struct Trajectory {
  std::vector<Truth> rows;
  bool with_states;  // velocities and biases are in the file, else velocities are from its poses, biases unknown
};

Trajectory states_of(const TrajectoryFile& file) {
  Trajectory result{{}, true};
  for (std::size_t i = 0; i < file.poses.size(); ++i) {
    const auto& [time, pose] = file.poses[i];
    const ImuBias<double> bias = file.gyro_biases.empty() || file.accel_biases.empty()
                                     ? ImuBias<double>{}
                                     : ImuBias<double>{file.gyro_biases[i], file.accel_biases[i]};
    result.rows.push_back({{rotation(pose), file.velocities[i], position(pose), time}, bias});
  }
  return result;
}

/// Velocities are those of the parabola through a pose and its neighbours; a pose without two near ones is left out.
Trajectory states_of(const std::vector<Stamped<SO3xR3<double>>>& poses, double longest_gap) {
  Trajectory result{{}, false};
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    const auto& [t0, x0] = poses[i - 1];
    const auto& [t1, x1] = poses[i];
    const auto& [t2, x2] = poses[i + 1];
    const double h0 = seconds<double>(t1 - t0), h1 = seconds<double>(t2 - t1);
    if (h0 > longest_gap || h1 > longest_gap) continue;
    const Eigen::Vector3d v0 = (position(x1) - position(x0)) / h0, v1 = (position(x2) - position(x1)) / h1;
    result.rows.push_back({{rotation(x1), (h1 * v0 + h0 * v1) / (h0 + h1), position(x1), t1}, ImuBias<double>{}});
  }
  return result;
}

Trajectory read_truth(const Options& o) {
  const TrajectoryFile file = read_trajectory(o.trajectory);
  const Trajectory truth = file.velocities.empty() ? states_of(file.poses, o.longest_gap) : states_of(file);
  if (truth.rows.empty()) {
    throw std::runtime_error(message(o.trajectory.string(), ": expected three poses in a row that are at most ",
                                     o.longest_gap, " s apart, to have a velocity (--longest-gap)"));
  }
  return truth;
}

/// The truth at a time: between two rows the cubic of their positions and velocities, and linear in the rest; nothing
/// outside the rows or in a gap between them.
std::optional<Truth> at(const Trajectory& truth, nanoseconds time, double longest_gap) {
  const auto& rows = truth.rows;
  const auto after = std::ranges::lower_bound(rows, time, {}, [](const Truth& row) { return row.state.time; });
  if (after == rows.end()) return std::nullopt;
  if (after->state.time == time) return *after;
  if (after == rows.begin()) return std::nullopt;
  const State &a = (after - 1)->state, &b = after->state;
  const ImuBias<double>&bias_a = (after - 1)->bias, &bias_b = after->bias;
  const double h = seconds<double>(b.time - a.time);
  if (h > longest_gap) return std::nullopt;
  const double s = seconds<double>(time - a.time) / h, r = 1 - s;
  const auto mix = [s, r](const Eigen::Vector3d& x, const Eigen::Vector3d& y) -> Eigen::Vector3d {
    return r * x + s * y;
  };
  const Sophus::SO3d R_WB = a.R_WB * GroupTraits<Sophus::SO3d>::exp(s * increment(a.R_WB, b.R_WB));
  const Eigen::Vector3d p_WB = a.p_WB + s * s * (1 + 2 * r) * (b.p_WB - a.p_WB) + h * s * r * (r * a.v_WB - s * b.v_WB);
  return Truth{{R_WB, mix(a.v_WB, b.v_WB), p_WB, time},
               {mix(bias_a.gyro, bias_b.gyro), mix(bias_a.accel, bias_b.accel)}};
}

/// How a scheme does over windows of one length.
struct Row {
  double window;                               // s
  std::vector<double> position{}, attitude{};  // errors at the ends, m and deg
  std::size_t gaps = 0;                        // that were bridged
  std::size_t skipped = 0;                     // windows whose end is not known
};

using Samples = std::vector<EurocImu>;

/// The error at the end of the window that begins with samples[first], where the truth is `start`.
template <typename Scheme>
void reckon_window(const Samples& samples, std::size_t first, std::size_t last, const Truth& start, const State& end,
                   const Options& o, Row& row) {
  const ImuBias<double> bias = o.keep_biases ? ImuBias<double>{} : start.bias;
  const GapOptions<double> gaps{o.longest_gap, o.bridge ? GapPolicy::bridge : GapPolicy::refuse};
  Integrator<Scheme, double, nanoseconds> integrator(start.state, o.gravity_vector(), gaps);
  try {
    for (std::size_t i = first; i <= last; ++i) {
      integrator.push(TimedImuSample<double, nanoseconds>{samples[i].time, samples[i].gyro - bias.gyro,
                                                          samples[i].accel - bias.accel});
    }
    integrator.finish();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(message(o.imu.string(), ": in the window of ", row.window, " s that begins at ",
                                     samples[first].time.count(), ": ", error.what()));
  }
  const State& state = integrator.state();
  row.gaps += integrator.gaps();
  row.position.push_back((state.p_WB - end.p_WB).norm());
  row.attitude.push_back(increment(end.R_WB, state.R_WB).norm() / units::degree);
}

/// Cuts the samples into windows, each beginning where the last one ends, and integrates each from the truth there. A
/// window ends with the sample nearest to its length, if that is so to within 1 %.
template <typename Scheme>
Row reckon(const Samples& samples, const Trajectory& truth, double window, const Options& o) {
  Row row{window};
  std::size_t first = 0;
  while (first + 1 < samples.size()) {
    const nanoseconds begin = samples[first].time, target = after(begin, window);
    const auto start = at(truth, begin, o.longest_gap);
    if (!start) {
      ++first;
      continue;
    }
    const auto next = std::ranges::lower_bound(samples.begin() + static_cast<std::ptrdiff_t>(first) + 1, samples.end(),
                                               target, {}, &EurocImu::time);
    auto last = static_cast<std::size_t>(next - samples.begin());
    const bool nearer_before = next == samples.end() || target - samples[last - 1].time < samples[last].time - target;
    if (nearer_before && last - 1 > first) --last;
    if (last == samples.size()) break;
    const bool as_long = std::abs(seconds<double>(samples[last].time - target)) <= 0.01 * window;
    if (!as_long && next == samples.end()) break;  // what is left over
    const auto end = at(truth, samples[last].time, o.longest_gap);
    if (as_long && end) {
      reckon_window<Scheme>(samples, first, last, *start, end->state, o, row);
    } else {
      ++row.skipped;
    }
    first = last;
  }
  if (row.position.empty()) {
    const auto span = [](nanoseconds from, nanoseconds to) { return message(from.count(), " to ", to.count(), " ns"); };
    throw std::runtime_error(message("no window of ", window, " s in which both files have data: ", o.imu.string(),
                                     " is from ", span(samples.front().time, samples.back().time), ", ",
                                     o.trajectory.string(), " from ",
                                     span(truth.rows.front().state.time, truth.rows.back().state.time)));
  }
  return row;
}

const std::map<std::string, Row (*)(const Samples&, const Trajectory&, double, const Options&)> schemes{
    {"euler", reckon<Euler>},       {"zero-order-hold", reckon<ZeroOrderHold>},
    {"midpoint", reckon<Midpoint>}, {"trapezoid", reckon<Trapezoid>},
    {"rk4", reckon<RungeKutta4>},   {"rk4-double-step", reckon<RungeKutta4DoubleStep>},
    {"magnus4", reckon<Magnus4>}};

/// The value below which `share` of the values are, linear between them; half way it is the median.
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

void write_table(const std::filesystem::path& path, const std::vector<Row>& rows) {
  AtomicFile file(path);
  file.append(
      "window_s,runs,skipped,gaps,position_median_m,position_90_m,position_max_m,attitude_median_deg,attitude_90_deg,"
      "attitude_max_deg\n");
  for (const Row& row : rows) {
    file.append(message(row.window, ',', row.position.size(), ',', row.skipped, ',', row.gaps));
    for (const double figure : figures(row)) {
      file.append(',');
      file.append_real(figure);
    }
    file.append('\n');
  }
  file.commit();
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
  const Samples samples = read_euroc_imu(o.imu);
  const Trajectory truth = read_truth(o);
  std::printf("%s: %zu samples over %g s\n%s: %zu %s over %g s\n", o.imu.string().c_str(), samples.size(),
              seconds<double>(samples.back().time - samples.front().time), o.trajectory.string().c_str(),
              truth.rows.size(), truth.with_states ? "states" : "poses between others",
              seconds<double>(truth.rows.back().state.time - truth.rows.front().state.time));
  std::vector<Row> rows;
  for (const double window : o.windows) rows.push_back(schemes.at(o.scheme)(samples, truth, window, o));

  std::printf("%s, velocities %s, biases %s\n\n", o.scheme.c_str(),
              truth.with_states ? "of the trajectory file" : "from its poses",
              o.keep_biases || !truth.with_states ? "not removed" : "as the trajectory file has them removed");
  print_table(rows);
  for (const Row& row : rows) {
    if (row.gaps > 0) {
      std::printf("%g s: gaps of more than %g s that were integrated across: %zu\n", row.window, o.longest_gap,
                  row.gaps);
    }
    if (row.skipped > 0) {
      std::printf("%g s: windows skipped for want of a sample or of truth at their end: %zu\n", row.window,
                  row.skipped);
    }
  }
  if (!o.csv.empty()) write_table(o.csv, rows);
}

void check(const Options& o) {
  for (const double window : o.windows) {
    if (!(window > 0 && window <= 1e6)) {
      throw std::invalid_argument(message("--windows: ", window, ", expected positive numbers of seconds, up to 1e6"));
    }
  }
  if (o.gravity.size() == 2) throw std::invalid_argument("--gravity: 2 numbers, expected 1 or 3");
  for (const double g : o.gravity) {
    if (!is_finite(g)) throw std::invalid_argument(message("--gravity: ", g, ", expected finite numbers"));
  }
  if (!(o.longest_gap > 0)) {
    throw std::invalid_argument(message("--longest-gap: ", o.longest_gap, ", expected a positive number of seconds"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Integrates the IMU samples of a file over windows, each from the true state of a trajectory file, and prints "
      "how far off the ends are.\n\n"
      "Velocities are those of the trajectory file where it has them (EuRoC ground truth of 17 columns), and its "
      "biases "
      "at the beginning of each window are removed; else velocities come from its poses, and no biases are removed."};
  Options o;
  app.add_option("imu", o.imu, "EuRoC IMU samples: ns wx wy wz ax ay az, commas or blanks between")->required();
  app.add_option("trajectory", o.trajectory, "EuRoC ground truth or TUM poses of the IMU")->required();
  app.add_option("--scheme", o.scheme, "integration scheme")->check(CLI::IsMember(schemes))->capture_default_str();
  app.add_option("--windows", o.windows, "lengths [s]")->capture_default_str();
  app.add_option("--gravity", o.gravity,
                 "acceleration of free fall in the world [m/s^2]: x y z, or its amount along -z")
      ->expected(1, 3)
      ->check(CLI::Number)
      ->capture_default_str();
  app.add_option("--longest-gap", o.longest_gap,
                 "between samples, and between poses [s]; a longer one of samples is refused, of poses has no truth")
      ->capture_default_str();
  app.add_flag("--bridge-gaps", o.bridge, "integrate across longer ones of samples, and count them");
  app.add_flag("--keep-biases", o.keep_biases, "do not remove the biases of the trajectory file");
  app.add_option("--csv", o.csv, "also write the table to this file");
  try {
    app.parse(argc, argv);
    check(o);
    run(o);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dead_reckon: %s\n", error.what());
    return 2;
  }
  return 0;
}
