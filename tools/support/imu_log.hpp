// SPDX-License-Identifier: MIT
// Static IMU logs as columns of numbers: EuRoC files, other tables, ROS bags.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <splinertia/allan/record/sampling.hpp>
#include <splinertia/imu/describe.hpp>
#include <string>
#include <string_view>
#include <vector>

/// How to read a log.
struct ImuLogOptions {
  /// What the columns of a table hold: t, gx, gy, gz, ax, ay, az, or - for a column to ignore. Empty: those of EuRoC,
  /// t,gx,gy,gz,ax,ay,az, or without t if there is a rate.
  std::vector<std::string> columns;
  std::optional<double> rate;                      ///< Hz, if there is no column t
  std::optional<std::string> time_unit;            ///< s, ms, us or ns; default: choose_stamp_unit
  std::optional<std::string> gyro_unit;            ///< rad/s or deg/s; default: rad/s if plausible
  std::optional<std::string> accel_unit;           ///< m/s2, g or mg; default: m/s2 if plausible
  double skip = 0;                                 ///< s at the beginning, for the sensor to warm up
  std::optional<double> until;                     ///< s from the beginning; later samples are left out
  std::vector<std::string> leave_out;              ///< time spans A-B, s from the beginning
  bool drop_duplicates = false;                    ///< rows whose stamp equals that of the row before
  splinertia::allan::SamplingLimits limits{};      ///< for the stamps
  std::optional<std::string> topic;                ///< of a ROS bag
  std::optional<std::filesystem::path> accel_log;  ///< of the accelerometer; `log` is then of the gyroscope
  std::vector<std::string> accel_columns;          ///< of accel_log; default: t,ax,ay,az, or without t if it has a rate
  std::optional<double> accel_rate;                ///< Hz, of accel_log, if it has no column t
  std::optional<std::string> accel_topic;          ///< of accel_log
  std::string python;                              ///< interpreter for reading a ROS bag
};

struct AxisLog {
  char name;                   ///< x, y, z
  std::vector<double> values;  ///< SI
};

/// A time span, s from the beginning of a log.
struct LogSpan {
  double begin, end;
};

/// When a sample was taken.
struct SampleTime {
  std::size_t sample;  ///< index among the samples that are kept
  double time;         ///< s from the beginning of the log, including parts that were left out
};

using LogSampling = splinertia::allan::Sampling<std::chrono::nanoseconds>;

/// A sensor has a rate of its own: the accelerometer may come from another log (ImuLogOptions::accel_log).
struct SensorLog {
  splinertia::SensorKind kind;
  std::vector<AxisLog> axes;
  std::string path;  ///< of the log
  std::size_t samples = 0;
  double rate = 0;                      ///< Hz
  std::optional<LogSampling> sampling;  ///< of the stamps, if there are any
  std::vector<SampleTime> times;        ///< of the first sample, of each one after a part left out, and of others

  /// The time of a sample, s from the beginning of the log, as in --leave-out.
  [[nodiscard]] double time_of(std::size_t sample) const;
};

struct ImuLog {
  std::string path;
  std::optional<std::string> topic;     ///< of the ROS bag
  std::size_t samples = 0;              ///< of the first sensor
  double rate = 0;                      ///< Hz, of the first sensor
  std::optional<LogSampling> sampling;  ///< of the first sensor
  std::vector<LogSpan> left_out;        ///< time spans inside the log; the parts before and after are joined
  std::string units;                    ///< assumed units of the sensors, as one line
  std::vector<SensorLog> sensors;       ///< gyroscope and accelerometer, if they have axes
  std::vector<std::string> report;      ///< how the log was read: lines for the report
  std::vector<std::string> warnings;    ///< a line each
};

/// gyroscope, accelerometer
[[nodiscard]] std::string_view sensor_name(splinertia::SensorKind kind);

/// Reads a log: a ROS bag (.bag, .mcap, .db3, a folder) or a table with a sample a line, commas or blanks between its
/// columns, # comments, and perhaps one line of names. Sensors of two logs are not joined: each keeps its samples and
/// its rate. Throws std::runtime_error or std::invalid_argument with one line that says what is wrong, where, and what
/// was expected, or ScriptFailed if the script has printed that. Besides malformed tables it rejects times that do not
/// increase, come in bursts, have too much jitter or too many gaps, and readings that are clearly in another unit.
[[nodiscard]] ImuLog read_imu_log(const std::filesystem::path& path, const ImuLogOptions& options);

/// Reads a file with one number per line; - is the standard input. Throws std::runtime_error as above.
[[nodiscard]] std::vector<double> read_numbers(const std::filesystem::path& path);
