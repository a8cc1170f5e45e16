// SPDX-License-Identifier: MIT
// Checks the units of a static log against the means of its readings.
#pragma once

#include "support/imu_log.hpp"

/// Adds the unit of a sensor to `log.units`, and a warning if the mean of the sensor looks like another unit. Throws
/// std::runtime_error instead if that is certain and the unit was not given.
void check_unit(const SensorLog& sensor, bool given, ImuLog& log);
