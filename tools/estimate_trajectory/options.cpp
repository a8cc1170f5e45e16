// SPDX-License-Identifier: MIT
#include "estimate_trajectory/options.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <stdexcept>

#include "support/common_options.hpp"
#include "support/concat.hpp"

void add_options(CLI::App& app, Options& o) {
  app.add_option("--duration", o.duration, "duration of the motion [s]")->capture_default_str();
  app.add_option("--knot-interval", o.knot_interval, "knot interval of the curve [s]")->capture_default_str();
  app.add_option("--imu-rate", o.imu_rate, "sampling rate of the IMU [Hz]")->capture_default_str();
  app.add_option("--pose-rate", o.pose_rate, "rate of the poses [Hz]")->capture_default_str();
  app.add_option("--position-noise", o.position_noise, "standard deviation of a position [m]")->capture_default_str();
  app.add_option("--attitude-noise", o.attitude_noise, "standard deviation of an attitude [rad]")
      ->capture_default_str();
  app.add_option("--gyro-noise", o.gyro_noise, "white noise density [rad/s/sqrt(Hz)]")->capture_default_str();
  app.add_option("--accel-noise", o.accel_noise, "white noise density [m/s^2/sqrt(Hz)]")->capture_default_str();
  app.add_option("--gravity-tilt", o.gravity_tilt, "error of the first guess of gravity [deg]")->capture_default_str();
  app.add_option("--iterations", o.iterations, "largest number of iterations")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_seed_option(app, o.seed, "seed of the noise; gives the same measurements on every machine");
  add_csv_option(app, o.csv, "also write the table of errors to this file");
}

void check(const Options& o) {
  const auto require = [](const char* name, double value, double most) {
    if (!(value > 0 && value <= most)) {
      throw std::invalid_argument(concat(name, ": ", value, ", expected a positive number up to ", most));
    }
  };
  require("--duration", o.duration, 1e4);
  require("--knot-interval", o.knot_interval, o.duration);
  require("--imu-rate", o.imu_rate, 1e5);
  require("--pose-rate", o.pose_rate, 1e5);
  require("--position-noise", o.position_noise, 1e3);
  require("--attitude-noise", o.attitude_noise, 3);
  require("--gyro-noise", o.gyro_noise, 1e3);
  require("--accel-noise", o.accel_noise, 1e3);
  if (!(std::abs(o.gravity_tilt) <= 180)) {
    throw std::invalid_argument(concat("--gravity-tilt: ", o.gravity_tilt, ", expected -180 to 180 degrees"));
  }
  if (!(o.duration * o.pose_rate >= 1)) {
    throw std::invalid_argument(
        concat("--pose-rate: ", o.pose_rate, " Hz gives fewer than 2 poses in ", o.duration, " s"));
  }
}
