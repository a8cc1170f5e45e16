// SPDX-License-Identifier: MIT
#pragma once

#include "support/allan_analysis.hpp"
#include "support/imu_log.hpp"

/// Prints tables and what they mean.
void print_report(const ImuLog& log, const LogNoise& noise);
