// SPDX-License-Identifier: MIT
// The stamps of an IMU log: their unit, and whether an IMU can have them.
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

/// The unit of stamps, from the first of them as text. It is the one in which they count from 1970 if no format says
/// otherwise, seconds if they have decimals, or else the usual one. Throws std::runtime_error that begins with `where`
/// and names --time-unit if an IMU cannot have such a rate.
[[nodiscard]] StampUnit choose_stamp_unit(std::span<const std::string> first_stamps,
                                          std::optional<splinertia::TimeUnit> usual, const std::string& where);

/// Throws std::runtime_error if no IMU can have this rate, or the log lasts less than a second. `unit` is that of the
/// stamps; without one (a ROS bag) --time-unit is not named.
void require_plausible_times(const LogSampling& sampling, std::optional<splinertia::TimeUnit> unit);
