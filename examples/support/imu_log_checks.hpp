// SPDX-License-Identifier: MIT
// What the readings of a static log give away of their units, and whether the sensor was at rest.
#pragma once

#include "support/imu_log.hpp"

/// Adds the unit of a sensor to `log.units`, and a warning if the mean of the sensor looks like another unit. Throws
/// std::runtime_error instead where that is sure and the unit has not been given.
void check_unit(const SensorLog& sensor, bool given, ImuLog& log);

/// Warns of stretches that vary more than most.
void check_stillness(const SensorLog& sensor, ImuLog& log);
