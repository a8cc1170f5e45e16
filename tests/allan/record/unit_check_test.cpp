// SPDX-License-Identifier: MIT
#include <cmath>
#include <splinertia/allan/record/unit_check.hpp>
#include <stdexcept>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using Eigen::Vector3d;

TEST_CASE("gravity is recognised in m/s², g, mg and cm/s², in any direction") {
  const Vector3d up = Vector3d(0.6, -0.64, 0.48).normalized();
  const auto of = [&](double norm) { return recognize_accelerometer_mean(norm * up); };
  for (const double g : {9.78, 9.81, 9.83, 9.4, 10.2}) CHECK(of(g) == AccelerometerMean::gravity);
  for (const double g : {1.0, 0.97, 1.04}) CHECK(of(g) == AccelerometerMean::gravity_in_g);
  for (const double g : {1000.0, 981.0, 960.0}) CHECK(of(g) == AccelerometerMean::gravity_in_milli_g);
  for (const double g : {0.0, 0.2}) CHECK(of(g) == AccelerometerMean::no_gravity);
  for (const double g : {0.8, 2.0, 8.8, 11.0, 100.0, 16384.0}) CHECK(of(g) == AccelerometerMean::unclear);
}

TEST_CASE("a gyroscope at rest does not read 1 rad/s") {
  CHECK(plausible_gyroscope_mean(Vector3d(0.3, -0.2, 0.1)));
  CHECK(plausible_gyroscope_mean(Vector3d::Zero()));
  CHECK_FALSE(plausible_gyroscope_mean(Vector3d(1.2, 0, 0)));
  CHECK_FALSE(plausible_gyroscope_mean(Vector3d(0, 0, 15.04)));  // the Earth's rate in °/h
}

TEST_CASE("white noise that no gyroscope has is in another unit") {
  const auto of = [](double N) { return check_gyroscope_white_noise(N); };
  const double from_degrees = splinertia::units::degree_per_root_hour;
  for (const double N : {3e-4, 2e-3, 0.1, 0.6, 15.0}) CHECK(of(N * from_degrees) == WhiteNoiseCheck::plausible);
  CHECK(of(1e-3 / splinertia::units::degree) == WhiteNoiseCheck::too_large);  // 1e-3 rad/s/√Hz in °/s
  CHECK(of(1.97e2 * from_degrees) == WhiteNoiseCheck::too_large);
  CHECK(of(1e-8) == WhiteNoiseCheck::too_small);
  CHECK(of(0) == WhiteNoiseCheck::too_small);
}

TEST_CASE("white noise that no accelerometer has is in another unit") {
  const auto of = [](double N) { return check_accelerometer_white_noise(N); };
  for (const double N : {0.02, 7.0, 300.0, 15000.0}) {
    CHECK(of(N * splinertia::units::micro_g_per_root_hertz) == WhiteNoiseCheck::plausible);
  }
  CHECK(of(300) == WhiteNoiseCheck::too_large);  // in µg
  CHECK(of(1e-8) == WhiteNoiseCheck::too_small);
}

TEST_CASE("white noise that is no number") {
  using splinertia::test::error_of;
  CHECK(error_of<std::invalid_argument>([] { (void)check_gyroscope_white_noise(NAN); }) ==
        "check_gyroscope_white_noise: N is nan, expected a finite number >= 0");
  CHECK(error_of<std::invalid_argument>([] { (void)check_accelerometer_white_noise(-1); }) ==
        "check_accelerometer_white_noise: N is -1, expected a finite number >= 0");
}
