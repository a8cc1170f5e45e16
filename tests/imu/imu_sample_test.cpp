// SPDX-License-Identifier: MIT
#include <splinertia/imu/imu_measurement.hpp>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/imu/simulate.hpp>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
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

TEST_CASE("Writers take samples over any time and of any scalar") {
  STATIC_CHECK(ImuSampleLike<Own>);
  STATIC_CHECK(ImuSampleLike<StampedImuReading<float, nanoseconds>>);
  STATIC_CHECK(ImuIncrementLike<ImuIncrement<float, nanoseconds>>);
  STATIC_CHECK_FALSE(ImuSampleLike<NoTime>);
  STATIC_CHECK_FALSE(ImuSampleLike<ImuIncrement<>>);
  STATIC_CHECK_FALSE(ImuSampleLike<int>);
}

TEST_CASE("A simulated reading is a sample") {
  const ImuReading reading{{1.5, {1, 2, 3}, {4, 5, 6}}, {7, 8, 9}, {10, 11, 12}};
  const ImuSample<> sample = reading;  // without the biases
  CHECK(sample.time == 1.5);
  CHECK(sample.accel == reading.accel);
}
