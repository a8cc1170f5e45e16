// SPDX-License-Identifier: MIT
// The stamps of an IMU log: their unit, and whether they are plausible.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <splinertia/io/trajectory_format.hpp>
#include <string>

#include "support/imu_log.hpp"

struct StampUnit {
  splinertia::TimeUnit unit;
  std::string note;  ///< why, for the report; empty: it is the usual one
};

/// Infers the unit of stamps from the first ones as text. If no format fixes it, it is the one in which they count from
/// 1970, or seconds if they have decimals; otherwise it is the usual one. Throws std::runtime_error that begins with
/// `where` and names --time-unit if the rate is not plausible for an IMU.
[[nodiscard]] StampUnit choose_stamp_unit(std::span<const std::string> first_stamps,
                                          std::optional<splinertia::TimeUnit> usual, const std::string& where);

/// Throws std::runtime_error if the rate is too high for an IMU, or the log lasts less than a second. `unit` is that of
/// the stamps; without it (a ROS bag) the message does not name --time-unit.
void require_plausible_times(const LogSampling& sampling, std::optional<splinertia::TimeUnit> unit);
