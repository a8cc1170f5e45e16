// SPDX-License-Identifier: MIT
// The main job: a trajectory goes in, what an IMU would have measured along it comes out, and integrating that back
// shows how far the noise and the integration scheme carry the estimate away.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/euroc.hpp>
#include <splinertia/io/npy_imu.hpp>
#include <splinertia/io/tum.hpp>
#include <splinertia/splinertia.hpp>
#include <string>
#include <vector>

#include "support/any_error_model.hpp"
#include "support/error_yaml.hpp"
#include "support/kalibr.hpp"
#include "support/progress.hpp"
#include "support/trajectory_fit.hpp"
#include "support/trajectory_input.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

struct Options {
  std::filesystem::path trajectory;  // empty: an analytic motion
  TrajectoryInput input;             // how to read it
  std::string motion = "ellipse";
  double duration = 20;
  std::optional<double> rate;  // default: that of the Kalibr file, else 200
  std::string preset = "course";
  std::filesystem::path errors, kalibr;
  std::optional<double> gyro_noise, gyro_walk, accel_noise, accel_walk;
  std::vector<double> gravity{0, 0, -9.80665};
  std::uint64_t seed = 0;
  std::string group = "split";
  int order = 4;
  std::optional<double> knot_interval;
  std::filesystem::path output = ".";
  std::filesystem::path csv;
  bool npy = false;
  bool help_errors = false;

  Eigen::Vector3d gravity_vector() const {
    return gravity.size() == 1 ? Eigen::Vector3d(0, 0, -gravity[0]) : Eigen::Vector3d(gravity.data());
  }
};

struct RunningError {
  double squares = 0, largest = 0, last = 0;
  std::size_t count = 0;

  void add(double error) {
    squares += error * error;
    largest = std::max(largest, error);
    last = error;
    ++count;
  }
  double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
};

/// Integrates samples as they come and compares with the truth.
template <typename Scheme, typename Time>
struct DeadReckoning {
  const char* imu;
  const char* scheme;
  Eigen::Vector3d gravity;
  RunningError position{}, attitude{};  // m, deg
  std::optional<Integrator<Scheme, double, Time>> integrator{};

  void add(const auto& sample, const NavState<double, Time>& truth) {
    if (!integrator) {
      auto initial = truth;
      initial.time = sample.time;  // the IMU's clock is all that it has
      integrator.emplace(initial, gravity);
    }
    integrator->push(sample);
    const NavState<double, Time>& state = integrator->state();
    position.add((state.p_WB - truth.p_WB).norm());
    attitude.add(increment(truth.R_WB, state.R_WB).norm() / units::degree);
  }
};

void print_table(const auto&... runs) {
  std::puts("\nIntegrated back from the true initial state:\n");
  std::puts("                     position error [m]              attitude error [deg]");
  std::puts("IMU    scheme         rms        max        end        rms        max        end");
  const auto row = [](const auto& r) {
    std::printf("%-6s %-9s %10.3g %10.3g %10.3g %10.3g %10.3g %10.3g\n", r.imu, r.scheme, r.position.rms(),
                r.position.largest, r.position.last, r.attitude.rms(), r.attitude.largest, r.attitude.last);
  };
  (row(runs), ...);
}

void write_table(AtomicFile& file, const auto&... runs) {
  file.append(
      "imu,scheme,position_rms_m,position_max_m,position_end_m,attitude_rms_deg,attitude_max_deg,attitude_end_deg\n");
  const auto row = [&](const auto& r) {
    file.append(message(r.imu, ',', r.scheme));
    for (const double value : {r.position.rms(), r.position.largest, r.position.last, r.attitude.rms(),
                               r.attitude.largest, r.attitude.last}) {
      file.append(',');
      file.append_real(value);
    }
    file.append('\n');
  };
  (row(runs), ...);
  file.commit();
}

const std::map<std::string, AnyImu>& preset_imus() {
  static const std::map<std::string, AnyImu> table{{"course", any_imu(presets::course)},
                                                   {"course-quiet", any_imu(presets::course_quiet)},
                                                   {"mpu6050", any_imu(presets::mpu6050)},
                                                   {"adis16448", any_imu(presets::adis16448)},
                                                   {"stim300", any_imu(presets::stim300)},
                                                   {"euroc", any_imu(presets::euroc)},
                                                   {"ideal", any_imu(Imu<>{})}};
  return table;
}

/// What the simulated IMU does wrong, and its rate.
struct Sensor {
  AnyImu errors;
  double rate = 200;
};

Sensor sensor_of(const Options& o) {
  Sensor sensor;
  if (!o.errors.empty()) {
    sensor.errors = read_error_yaml(o.errors);
  } else if (!o.kalibr.empty()) {
    const KalibrImu imu = read_kalibr(o.kalibr);
    sensor.errors = errors_of(imu);
    sensor.rate = imu.update_rate;
  } else {
    sensor.errors = preset_imus().at(o.preset);
  }
  // A noise given by hand replaces those of its kind.
  const auto replace = [](AnySensorModel& model, const auto& density, auto make) {
    if (density) model.replace(make(*density));
  };
  const auto walk = [](double density) { return RandomWalk{density}; };
  const auto noise = [](double density) { return WhiteNoise{density}; };
  replace(sensor.errors.gyro, o.gyro_walk, walk);
  replace(sensor.errors.gyro, o.gyro_noise, noise);
  replace(sensor.errors.accel, o.accel_walk, walk);
  replace(sensor.errors.accel, o.accel_noise, noise);
  if (o.rate) sensor.rate = *o.rate;
  return sensor;
}

/// Simulates along `truth`, writes the files and prints how well the samples integrate back.
template <typename Curve>
void simulate_along(const Curve& truth, const Options& o, typename Simulation<const Curve&, Imu<>>::Options run) {
  using Time = typename Curve::Time;
  const Sensor sensor = sensor_of(o);
  run.rate = sensor.rate;
  run.seed = o.seed;
  run.gravity = o.gravity_vector();
  const auto ideal = simulate(truth, Imu{}, run);
  const auto noisy = simulate(truth, sensor.errors, run);
  const double duration = seconds<double>(noisy.time(noisy.size() - 1) - noisy.time(0));
  std::printf("IMU: %zu samples at %g Hz, %g s, seed %llu\n", noisy.size(), run.rate, duration,
              static_cast<unsigned long long>(o.seed));
  std::fputs(describe(sensor.errors).c_str(), stdout);

  std::error_code error;
  std::filesystem::create_directories(o.output, error);
  if (error) throw std::runtime_error(message(o.output.string(), ": cannot create this folder: ", error.message()));
  EurocImuWriter imu_csv(o.output / "imu.csv");
  std::optional<NpyImuWriter> imu_npy;
  if (o.npy) imu_npy.emplace(o.output / "imu.npy");
  EurocGroundtruthWriter groundtruth_csv(o.output / "groundtruth.csv");
  TumWriter poses_tum(o.output / "poses.tum");
  std::optional<AtomicFile> table_csv, imu_yaml;
  if (!o.csv.empty()) table_csv.emplace(o.csv);
  if (const auto noise = kalibr_noise(sensor.errors, run.rate)) {
    imu_yaml.emplace(o.output / "imu.yaml");
    imu_yaml->append(kalibr_text(*noise));
  }

  DeadReckoning<Euler, Time> ideal_euler{"ideal", "Euler", run.gravity};
  DeadReckoning<Midpoint, Time> ideal_midpoint{"ideal", "Midpoint", run.gravity};
  DeadReckoning<Euler, Time> noisy_euler{"noisy", "Euler", run.gravity};
  DeadReckoning<Midpoint, Time> noisy_midpoint{"noisy", "Midpoint", run.gravity};
  Progress progress(noisy.size());
  std::size_t lost = noisy.size();
  auto reading = noisy.begin();
  for (const auto& ideal_reading : ideal) {
    progress.advance();
    const auto state = nav_state(truth.template evaluate<1>(ideal_reading.time), ideal_reading.time);
    ideal_euler.add(ideal_reading, state);
    ideal_midpoint.add(ideal_reading, state);
    if (reading == noisy.end() || reading->true_time != ideal_reading.time) continue;  // this one was dropped
    noisy_euler.add(*reading, state);
    noisy_midpoint.add(*reading, state);

    const nanoseconds time = to_nanoseconds(ideal_reading.time);
    const SO3xR3<double> pose{state.R_WB, state.p_WB};
    const EurocImu imu{to_nanoseconds(reading->time), reading->gyro, reading->accel};
    imu_csv.append(imu);
    if (imu_npy) imu_npy->append(imu);
    groundtruth_csv.append(EurocState{time, pose, state.v_WB, reading->gyro_bias, reading->accel_bias});
    poses_tum.append(Stamped<SO3xR3<double>>{time, pose});
    ++reading;
    --lost;
  }
  if (lost > 0) std::printf("%zu samples were dropped\n", lost);
  imu_csv.commit();
  if (imu_npy) imu_npy->commit();
  groundtruth_csv.commit();
  poses_tum.commit();
  if (imu_yaml) imu_yaml->commit();
  std::printf("wrote imu.csv,%s groundtruth.csv%s poses.tum%s to %s\n", o.npy ? " imu.npy," : "",
              imu_yaml ? "," : " and", imu_yaml ? " and imu.yaml" : "", o.output.string().c_str());
  print_table(ideal_euler, ideal_midpoint, noisy_euler, noisy_midpoint);
  if (table_csv) write_table(*table_csv, ideal_euler, ideal_midpoint, noisy_euler, noisy_midpoint);
}

template <Pose G, int Order>
void simulate_poses(const Poses& poses, const Options& o) {
  using Curve = UniformCurve<G, Order>;
  const double knot_interval = o.knot_interval.value_or(default_knot_interval(poses));
  const auto result = about(o.trajectory, [&] {
    return fit<Curve>(fit_data<Curve>(poses, "poses"), {.knot_interval = knot_interval, .loss = RobustLoss::huber()});
  });
  const Curve& curve = result.spline;
  const PoseDistances off = distances(curve, poses);
  const Lengths distance = lengths(off.position);
  std::printf("%s: %zu poses over %g s, longest gap %g s\n", o.trajectory.string().c_str(), poses.size(),
              seconds<double>(poses.back().time - poses.front().time), seconds<double>(longest_interval(poses)));
  std::printf(
      "     spline of order %d on %s, %zu control points %.4g s apart, within %.3g m (rms), %.3g m (max) of the "
      "poses\n",
      Order, SplitPose<G> ? "SO(3) x R^3" : "SE(3)", curve.control_points().size(),
      seconds<double>(curve.knots().interval), distance.rms, distance.max);
  if (!result.converged) {
    std::printf("     the fit has not converged after %d linear systems, this is the best of it\n", result.iterations);
  }
  const auto list = [](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) std::printf("       %s\n", line.c_str());
  };
  constexpr std::size_t most = 5;
  if (!result.outliers.empty()) {
    std::printf("     %zu poses lie off by more than 6 standard deviations (fit_trajectory tells more):\n",
                result.outliers.size());
    list(outlier_lines(poses, off, result.outliers, most));
  }
  if (!result.gaps.empty()) {
    std::puts("     gaps between the poses, across which the curve takes the way of least acceleration:");
    list(gap_lines(poses, result.gaps, most));
  }
  simulate_along(curve, o, {});
}

void simulate_file(const Options& o) {
  const TrajectoryInput input{o.trajectory, o.input.format, o.input.topic};
  const TrajectoryFile file = read_trajectory_input(input);
  std::fputs(note_lines(input, file).c_str(), stdout);
  const Poses& poses = file.poses;
  if (poses.size() < static_cast<std::size_t>(o.order)) {
    throw std::runtime_error(message(o.trajectory.string(), ": ", poses.size(), " poses, expected at least ", o.order,
                                     ", the order of the spline"));
  }
  const auto with_group = [&]<typename G>() {
    switch (o.order) {
      case 3:
        return simulate_poses<G, 3>(poses, o);
      case 4:
        return simulate_poses<G, 4>(poses, o);
      case 5:
        return simulate_poses<G, 5>(poses, o);
      default:
        return simulate_poses<G, 6>(poses, o);
    }
  };
  o.group == "split" ? with_group.operator()<SO3xR3<double>>() : with_group.operator()<Sophus::SE3d>();
}

void simulate_analytic(const Options& o) {
  std::printf("%s: analytic motion, exact samples\n", o.motion.c_str());
  const auto run = [&](const auto& motion) { simulate_along(motion, o, {.start = 0.0, .end = o.duration}); };
  if (o.motion == "ellipse") run(Ellipse<>{});
  if (o.motion == "circle") run(Circle<>{.radius = 5, .rate = 0.4, .height = 1});
  if (o.motion == "coning") run(Coning<>{.angle = 0.1, .rate = 10});
  if (o.motion == "rest") run(at_rest(SO3xR3<double>{}));
}

/// Adds the options to the command line. CLI11 checks what is a matter of form; the library checks the values.
void add_options(CLI::App& app, Options& o) {
  auto* trajectory = app.add_option(
      "trajectory", o.trajectory, "trajectory of any format below, or a ROS bag; without it an analytic motion");
  app.add_option("--motion", o.motion, "analytic motion")
      ->check(CLI::IsMember({"ellipse", "circle", "coning", "rest"}))
      ->excludes(trajectory)
      ->capture_default_str();
  app.add_option("--duration", o.duration, "of an analytic motion [s]")->excludes(trajectory)->capture_default_str();
  app.add_option("--rate", o.rate, "IMU samples a second [Hz]; default: that of the Kalibr file, else 200");
  auto* preset =
      app.add_option("--preset", o.preset, "a known IMU")->check(CLI::IsMember(preset_imus()))->capture_default_str();
  auto* errors = app.add_option("--errors", o.errors, "YAML file that lists its errors, see --help-errors");
  auto* kalibr = app.add_option("--kalibr", o.kalibr, "Kalibr imu.yaml with its noise and rate");
  preset->excludes(errors)->excludes(kalibr);
  errors->excludes(kalibr);
  app.add_option("--gyro-noise", o.gyro_noise, "white noise density [rad/s/sqrt(Hz)], in place of that of the above");
  app.add_option("--gyro-walk", o.gyro_walk, "random walk density [rad/s^2/sqrt(Hz)], likewise");
  app.add_option("--accel-noise", o.accel_noise, "white noise density [m/s^2/sqrt(Hz)], likewise");
  app.add_option("--accel-walk", o.accel_walk, "random walk density [m/s^3/sqrt(Hz)], likewise");
  app.add_option("--gravity", o.gravity,
                 "acceleration of free fall in the world [m/s^2]: x y z, or its amount along -z")
      ->expected(1, 3)
      ->check(CLI::Number)
      ->capture_default_str();
  app.add_option("--seed", o.seed, "of the noise; the same seed gives the same samples everywhere")
      ->capture_default_str();
  app.add_option("--order", o.order, "of the spline through a trajectory file: degree + 1")
      ->check(CLI::Range(3, 6))
      ->needs(trajectory)
      ->capture_default_str();
  app.add_option("--group", o.group, "of that spline: split is SO(3) x R^3, se3 is SE(3)")
      ->check(CLI::IsMember({"split", "se3"}))
      ->needs(trajectory)
      ->capture_default_str();
  app.add_option("--knot-interval", o.knot_interval,
                 "of that spline [s]; default: 0.05, or where poses are sparse two of their intervals")
      ->needs(trajectory);
  add_trajectory_options(app, o.input, trajectory);
  app.add_option("-o,--output", o.output,
                 "folder for imu.csv, groundtruth.csv (EuRoC), poses.tum (TUM) and imu.yaml (Kalibr)")
      ->capture_default_str();
  app.add_flag("--npy", o.npy, "also write the samples as imu.npy, for numpy.load()");
  app.add_option("--csv", o.csv, "also write the table of integration errors to this file");
  app.add_flag("--help-errors", o.help_errors, "say what a file for --errors can hold, and exit");
}

void check(const Options& o) {
  if (o.gravity.size() == 2) throw std::invalid_argument("--gravity: 2 numbers, expected 1 or 3");
  if (!(o.duration > 0) || !std::isfinite(o.duration)) {
    throw std::invalid_argument(message("--duration: ", o.duration, ", expected a positive number of seconds"));
  }
  if (o.knot_interval && !(*o.knot_interval >= 1e-6 && *o.knot_interval <= 1e6)) {
    throw std::invalid_argument(message("--knot-interval: ", *o.knot_interval, ", expected 1e-6 to 1e6 seconds"));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Simulates an IMU along a trajectory, writes its samples and the ground truth, and integrates them back.\n\n"
      "To the poses of a file a smooth spline is fitted, from the first to the last; how far it is from them, which "
      "lie "
      "off,\nand where they have gaps, is printed. The ground truth written is that of the spline."};
  Options options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
    if (options.help_errors) {
      std::fputs(error_yaml_help().c_str(), stdout);
      return 0;
    }
    check(options);
    options.trajectory.empty() ? simulate_analytic(options) : simulate_file(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simulate_imu: %s\n", error.what());
    return 2;
  }
  return 0;
}
