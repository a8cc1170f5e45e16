// SPDX-License-Identifier: MIT
// What the readings of a static log give away of their units.
#pragma once

#include "support/imu_log.hpp"

/// Adds the unit of a sensor to `log.units`, and a warning if the mean of the sensor looks like another unit. Throws
/// std::runtime_error instead where that is sure and the unit has not been given.
void check_unit(const SensorLog& sensor, bool given, ImuLog& log);
