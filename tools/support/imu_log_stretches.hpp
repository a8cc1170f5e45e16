// SPDX-License-Identifier: MIT
// Leaves parts of an IMU log out of the analysis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "support/imu_log.hpp"
#include "support/imu_log_columns.hpp"

struct LeftOut {
  std::vector<LogSpan> inside;       ///< time spans left out between two samples that are kept
  std::size_t rows_inside = 0;       ///< number of rows in them
  std::vector<SampleTime> times;     ///< for SensorLog
  std::vector<std::int64_t> breaks;  ///< of each span, the index of the first sample after it among those that are kept
};

/// Removes the rows that --skip, --until and --leave-out select. Their times count from the beginning of the log. A
/// sample at the beginning of a time span belongs to it, one at its end does not. Throws std::invalid_argument for a
/// malformed span, for one without samples, and if no samples are kept.
LeftOut leave_out(ImuColumns& columns, const ImuLogOptions& options, std::optional<double> rate);
