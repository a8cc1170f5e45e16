// SPDX-License-Identifier: MIT
#include <splinertia/allan/unit_check.hpp>

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
