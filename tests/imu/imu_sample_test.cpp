// SPDX-License-Identifier: MIT
#include <splinertia/errors/imu_measurement.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/imu/simulate.hpp>

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
  STATIC_CHECK(ImuSampleOf<Own, double, double>);
  STATIC_CHECK(ImuSampleOf<ImuReading, double, double>);
  STATIC_CHECK(ImuSampleOf<ImuSample<double, nanoseconds>, double, nanoseconds>);
  STATIC_CHECK(ImuIncrementOf<ImuIncrement<double, nanoseconds>, double, nanoseconds>);
  STATIC_CHECK_FALSE(ImuSampleOf<NoTime, double, double>);
  STATIC_CHECK_FALSE(ImuSampleOf<ImuIncrement<>, double, double>);
  STATIC_CHECK_FALSE(ImuIncrementOf<ImuSample<>, double, double>);
  STATIC_CHECK_FALSE(ImuSampleOf<Own, double, nanoseconds>);  // seconds do not become ticks unasked
}
