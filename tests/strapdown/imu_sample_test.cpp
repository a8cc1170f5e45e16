// SPDX-License-Identifier: MIT
#include <splinertia/imu/imu_measurement.hpp>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/strapdown/imu_sample.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {
struct Own {
  double time;
  Eigen::Vector3d gyro, accel;
  double temperature;
};
struct NoTime {
  Eigen::Vector3d gyro, accel;
};
}  // namespace

TEST_CASE("What has time, gyro and accel is a sample; what has sums is an increment") {
  STATIC_CHECK(ImuSample<Own, double, double>);
  STATIC_CHECK(ImuSample<ImuReading, double, double>);
  STATIC_CHECK(ImuSample<TimedImuSample<double, nanoseconds>, double, nanoseconds>);
  STATIC_CHECK(ImuIncrement<TimedImuIncrement<double, nanoseconds>, double, nanoseconds>);
  STATIC_CHECK_FALSE(ImuSample<NoTime, double, double>);
  STATIC_CHECK_FALSE(ImuSample<TimedImuIncrement<double, double>, double, double>);
  STATIC_CHECK_FALSE(ImuIncrement<TimedImuSample<double, double>, double, double>);
  STATIC_CHECK_FALSE(ImuSample<Own, double, nanoseconds>);  // seconds do not become ticks unasked
}
