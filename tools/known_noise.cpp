// SPDX-License-Identifier: MIT
// Simulates IMUs at rest with known noise, writes their samples as csv and as a ROS bag, reads them back from the bag,
// identifies the noise and compares it with the truth: an Allan analysis from end to end.

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <splinertia/io/euroc.hpp>
#include <splinertia/splinertia.hpp>
#include <string>
#include <string_view>

#include "support/allan_analysis.hpp"
#include "support/allan_files.hpp"
#include "support/common_options.hpp"
#include "support/formatted.hpp"
#include "support/imu_log.hpp"
#include "support/program.hpp"
#include "support/progress.hpp"
#include "support/python_script.hpp"

using namespace splinertia;

namespace {

struct Options {
  double duration = 7200;
  double rate = 200;
  std::uint64_t seed = 0;
  std::string format = "bag";
  std::filesystem::path output = "known_noise";
  std::string python;
  bool no_plot = false;
};

/// White noise [unit/√Hz] and random walk [unit/s/√Hz] of a sensor.
struct Densities {
  double N, K;
};

struct KnownImu {
  std::string_view name;
  Densities gyro, accel;
};

// The two sets of parameters of a well-known course, whose own analysis of two hours found N to 1–3 % and K to an order
// of magnitude.
constexpr std::array<KnownImu, 2> known_imus{KnownImu{"course", {0.015, 5e-5}, {0.019, 5e-4}},
                                             KnownImu{"course_quiet", {0.005, 1e-5}, {3e-4, 1e-4}}};

/// Writes samples of an IMU at rest, z up. They start one second after the epoch, because bags have no time zero.
void simulate_to(const std::filesystem::path& csv, const KnownImu& known, const Options& o) {
  using std::chrono::nanoseconds;
  const Imu imu{ErrorModel{RandomWalk{known.gyro.K}, WhiteNoise{known.gyro.N}},
                ErrorModel{RandomWalk{known.accel.K}, WhiteNoise{known.accel.N}}};
  const auto samples =
      simulate(at_rest(SO3xR3<double>{}), imu, {.rate = o.rate, .seed = o.seed, .start = 1.0, .end = 1.0 + o.duration});
  Progress progress(samples.size());
  EurocImuWriter writer(csv);
  struct Sample {
    nanoseconds time;
    Eigen::Vector3d gyro, accel;
  };
  for (const auto& reading : samples) {
    writer.append(Sample{to_nanoseconds(reading.time), reading.gyro, reading.accel});
    progress.advance();
  }
  writer.commit();
}

/// Prints one coefficient: truth, estimate, interval, error, and whether the truth is in the interval.
void compare(std::string_view sensor, allan::NoiseTerm term, double truth, const allan::Estimate<double>& estimate) {
  const bool inside = estimate.interval.lower <= truth && truth <= estimate.interval.upper;
  if (estimate.detected) {
    std::printf("%-13s %s  %9.3g %11.5g  %9.5g … %-9.5g %6.2f %%  %s\n", std::string(sensor).c_str(),
                std::string(symbol(term)).c_str(), truth, estimate.value, estimate.interval.lower,
                estimate.interval.upper, 100 * std::abs(estimate.value / truth - 1), inside ? "yes" : "no");
  } else {
    std::printf("%-13s %s  %9.3g %s, below %-9.3g    %s\n", std::string(sensor).c_str(),
                std::string(symbol(term)).c_str(), truth,
                estimate.possible ? formatted("perhaps %.3g", estimate.value).c_str() : "not detected",
                estimate.interval.upper, inside ? "yes" : "no");
  }
}

void run(const KnownImu& known, const Options& o) {
  const std::filesystem::path folder = o.output / known.name;
  std::filesystem::create_directories(folder);
  const std::filesystem::path csv = folder / "imu.csv", bag = folder / ("imu." + o.format);
  std::printf("\n%s: %g s at %g Hz\n", std::string(known.name).c_str(), o.duration, o.rate);
  simulate_to(csv, known, o);
  PythonScript(o.python, "imu_bag.py", {"to-bag", csv.string(), bag.string()}, PythonScript::Output::shared).finish();

  ImuLogOptions reading;
  reading.python = o.python;
  const LogNoise noise = analyse(read_imu_log(bag, reading), {});
  OutputFolder output(folder, "known_noise", {});
  if (!o.no_plot) output.expect_pictures("allan");
  write_files(noise, output);
  if (!o.no_plot) {
    PythonScript(o.python, "plot_allan.py", {folder.string()}, PythonScript::Output::shared).finish();
  }
  std::puts("sensor        term  truth    estimate   95 % interval           off      in it");
  for (const SensorNoise& sensor : noise.sensors) {
    const Densities& truth = sensor.kind == SensorKind::gyro ? known.gyro : known.accel;
    // The estimate of all axes together, unless they differ. By chance this happens in one log out of a hundred.
    for (const auto& row : sensor.rows()) {
      if (sensor.pooled && row.name != "all") continue;
      compare(sensor_name(sensor.kind), allan::NoiseTerm::white, truth.N, row.noise->N);
      compare(sensor_name(sensor.kind), allan::NoiseTerm::random_walk, truth.K, row.noise->K);
    }
  }
  std::printf("files are in %s\n", folder.string().c_str());
}

}  // namespace

const Program this_program{
    "known_noise",
    "Simulates IMUs at rest with known noise, writes their samples as csv and as a ROS bag, reads them back from the "
    "bag, identifies and plots the noise, and compares it with the truth.",
    [](CLI::App& app) -> std::function<void()> {
      static Options options;
      app.add_option("--duration", options.duration, "duration [s]")
          ->check(CLI::Range(10.0, 1e6))
          ->capture_default_str();
      add_rate_option(app, options.rate)->check(CLI::Range(1.0, 1e5));
      add_seed_option(app, options.seed, "seed of the random numbers");
      app.add_option("--format", options.format, "format of the ROS bag: bag of ROS 1, mcap or db3 of ROS 2")
          ->check(CLI::IsMember({"bag", "mcap", "db3"}))
          ->capture_default_str();
      add_output_option(app, options.output,
                        "output folder, with a folder for each IMU: imu.csv, imu.bag, curves.csv, noise.csv, …");
      add_no_plot_option(app, options.no_plot, "allan");
      add_python_option(app, options.python, "with rosbags");
      return [] {
        for (const KnownImu& known : known_imus) run(known, options);
      };
    }};
