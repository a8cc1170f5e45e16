// SPDX-License-Identifier: MIT
// Stretches of an IMU log that are not to be analysed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "support/imu_log.hpp"
#include "support/imu_log_columns.hpp"

struct LeftOut {
  std::vector<LogSpan> inside;       ///< what was left out between two samples that stay
  std::size_t rows_inside = 0;       ///< of those
  std::vector<SampleTime> times;     ///< of SensorLog
  std::vector<std::int64_t> breaks;  ///< indices of the samples, of those that stay, before which it was
};

/// Removes what --skip, --until and --leave-out name. Their times count from the beginning of the log. A sample at the
/// beginning of a stretch belongs to it, one at its end does not. Throws std::invalid_argument for a range that is none
/// or has no sample, and if nothing stays.
LeftOut leave_out(ImuColumns& columns, const ImuLogOptions& options, std::optional<double> rate);
