// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <map>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/imu/presets.hpp>
#include <stdexcept>

#include "support/concat.hpp"
#include "support/error_yaml.hpp"
#include "support/imu_noise.hpp"

using namespace splinertia;

namespace {

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

void add_sensor_options(CLI::App& app, Options& o) {
  add_rate_option(app, o.rate, "sampling rate of the IMU [Hz]; default: that of --imu-noise, else 200");
  auto* preset = app.add_option("--preset", o.preset, "errors of a known IMU")
                     ->check(CLI::IsMember(preset_imus()))
                     ->capture_default_str();
  auto* errors = app.add_option("--errors", o.errors, "YAML file with the errors of the IMU, see --help-errors");
  auto* imu_noise = app.add_option("--imu-noise,--kalibr", o.imu_noise,
                                   "noise and rate of the IMU from a file of Kalibr, OpenVINS, VINS-Mono, VINS-Fusion, "
                                   "ORB-SLAM3, or of allan for GTSAM");
  preset->excludes(errors)->excludes(imu_noise);
  errors->excludes(imu_noise);
  app.add_option("--gyro-noise", o.gyro_noise, "white noise density [rad/s/sqrt(Hz)], replaces that of the IMU above");
  app.add_option("--gyro-walk", o.gyro_walk, "random walk density [rad/s^2/sqrt(Hz)], likewise");
  app.add_option("--accel-noise", o.accel_noise, "white noise density [m/s^2/sqrt(Hz)], likewise");
  app.add_option("--accel-walk", o.accel_walk, "random walk density [m/s^3/sqrt(Hz)], likewise");
  add_gravity_option(app, o.gravity);
  add_seed_option(app, o.seed, "seed of the noise; gives the same samples on every machine");
}

}  // namespace

void add_options(CLI::App& app, Options& o) {
  auto* trajectory = app.add_option("trajectory", o.input.file,
                                    "trajectory in any format below, or a ROS bag; default: an analytic motion");
  app.add_option("--motion", o.motion, "analytic motion")
      ->check(CLI::IsMember({"ellipse", "circle", "coning", "rest"}))
      ->excludes(trajectory)
      ->capture_default_str();
  app.add_option("--duration", o.duration, "duration of an analytic motion [s]")
      ->excludes(trajectory)
      ->capture_default_str();
  add_sensor_options(app, o);
  app.add_flag("--keep-holes", o.keep_holes, "keep the samples inside holes without poses, which are invented")
      ->needs(trajectory);
  add_output_option(app, o.output,
                    "folder for imu.csv (exists only if all files are complete), groundtruth.csv (EuRoC), poses.tum "
                    "(TUM), imu.yaml (Kalibr) and gaps.csv");
  app.add_flag("--npy", o.npy, "also write the samples as imu.npy, for numpy.load()");
  add_csv_option(app, o.csv, "also write the table of integration errors to this file");
  app.add_flag("--help-errors", o.help_errors, "print the error terms of a file for --errors, and exit");
  add_trajectory_options(app, o.input, trajectory);
  add_fit_options(app, o.fit, trajectory);
}

void check(const Options& o) {
  check(o.fit);
  constexpr double most = 9e9;  // s; 64-bit nanoseconds end at 292 years
  if (!(o.duration > 0 && o.duration <= most)) {
    throw std::invalid_argument(
        concat("--duration: ", o.duration, ", expected a positive number of seconds up to ", most));
  }
}

Sensor sensor_of(const Options& o) {
  Sensor sensor;
  if (!o.errors.empty()) {
    sensor.errors = read_error_yaml(o.errors);
  } else if (!o.imu_noise.empty()) {
    const ImuNoise imu = read_imu_noise(o.imu_noise, o.rate);
    sensor.errors = errors_of(imu);
    sensor.rate = imu.update_rate;
  } else {
    sensor.errors = preset_imus().at(o.preset);
  }
  // A noise density given as an option replaces the terms of its kind.
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
