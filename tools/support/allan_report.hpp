// SPDX-License-Identifier: MIT
#pragma once

#include "support/allan_analysis.hpp"
#include "support/imu_log.hpp"

/// Prints the tables of noise terms, what the terms mean, and the findings.
void print_report(const ImuLog& log, const LogNoise& noise);
