// SPDX-License-Identifier: MIT
// The Allan analysis of a static log: what is computed, written to files and printed.
#pragma once

#include <filesystem>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/identify.hpp>
#include <string>
#include <vector>

#include "support/imu_log.hpp"
#include "support/imu_noise.hpp"

struct AxisNoise {
  char name;  ///< x, y, z
  splinertia::allan::Curve<double> curve;
  splinertia::allan::NoiseEstimates<double> noise;
};

struct SensorNoise {
  splinertia::SensorKind kind;
  double rate;      ///< Hz
  double duration;  ///< s
  std::vector<AxisNoise> axes;
  splinertia::allan::NoiseEstimates<double> pooled;  ///< of all axes together
};

struct LogNoise {
  std::string log;  ///< its path
  double rate;      ///< Hz, of the first sensor
  double duration;  ///< s, of the first sensor
  splinertia::allan::IdentifyOptions<double> options;
  std::vector<SensorNoise> sensors;
  std::optional<std::string> topic{};  ///< of the ROS bag, if it is one
};

/// The overlapping Allan deviation of each axis with 68.3 % intervals, and the noise terms of each axis and of all.
/// So many axes at once, each in a thread. Throws std::runtime_error that names log, sensor and axis for a signal that
/// cannot be analysed.
[[nodiscard]] LogNoise analyse(const ImuLog& log, const splinertia::allan::IdentifyOptions<double>& options,
                               unsigned threads = 1);

/// The four densities that estimators want, and a line about each that needs one: those of all axes together, or of the
/// noisiest axis if the axes differ by more than their intervals; of what is not detected the upper limit, because
/// estimators refuse zero. Nothing if there are not both sensors, or not N and K among the candidates.
struct EstimatorNoise {
  ImuNoise imu;
  std::vector<std::string> comments;
};
[[nodiscard]] std::optional<EstimatorNoise> estimator_noise(const LogNoise& noise);

/// Writes curves.csv, noise.csv and, if there is an estimator_noise, a file for each of the estimators (imu.yaml, ...)
/// to a folder, which is made: all or none.
void write_files(const LogNoise& noise, const std::filesystem::path& folder,
                 const std::vector<Estimator>& for_estimators = {estimators.begin(), estimators.end()});

/// Prints tables and what they mean.
void print_report(const ImuLog& log, const LogNoise& noise);
