// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/errors/sensor_sample.hpp>
#include <splinertia/imu/imu_measurement.hpp>

namespace splinertia {

/// A sample of one sensor of an IMU as it passes through the error terms. An error that depends on the other sensor takes
/// this type, so that it does not compile in the model of any other sensor.
template <typename Scalar>
struct ImuSensorSample : SensorSample<Scalar, 3> {
  ImuMeasurement<Scalar> truth;  ///< what a perfect IMU measures
};

}  // namespace splinertia
