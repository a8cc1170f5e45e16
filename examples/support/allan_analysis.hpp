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
#include "support/kalibr.hpp"

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
};

/// The overlapping Allan deviation of each axis with 68.3 % intervals, and the noise terms of each axis and of all.
/// So many axes at once, each in a thread. Throws std::runtime_error that names log, sensor and axis for a signal that
/// cannot be analysed.
[[nodiscard]] LogNoise analyse(const ImuLog& log, const splinertia::allan::IdentifyOptions<double>& options,
                               unsigned threads = 1);

/// The four densities that Kalibr wants, and a line about each that needs one: those of all axes together, or of the
/// noisiest axis if the axes differ by more than their intervals; of what is not detected the upper limit, because
/// Kalibr refuses zero. Nothing if there are not both sensors, or not N and K among the candidates.
struct KalibrNoise {
  KalibrImu imu;
  std::vector<std::string> comments;
};
[[nodiscard]] std::optional<KalibrNoise> kalibr_noise(const LogNoise& noise);

/// Writes curves.csv, noise.csv and, if there is one, imu.yaml (kalibr_noise) to a folder, which is made: all or none.
void write_files(const LogNoise& noise, const std::filesystem::path& folder);

/// Prints tables and what they mean.
void print_report(const ImuLog& log, const LogNoise& noise);
