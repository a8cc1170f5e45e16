// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <splinertia/imu/imu.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/npy_imu.hpp>
#include <splinertia/io/tum.hpp>
#include <string>
#include <vector>

#include "dead_reckoning.hpp"
#include "options.hpp"
#include "support/holes.hpp"
#include "support/output_folder.hpp"

/// The folder for the output files. Throws std::invalid_argument if one of them is an input of the run; gaps.csv, which
/// is not always written, is checked when it is begun.
[[nodiscard]] OutputFolder output_folder(const Options& options, const Sensor& sensor);

/// The files of a run. All appear with commit(), or none. imu.csv exists only if all others do.
class Output {
 public:
  /// Creates the folder and begins the files.
  Output(const Options& options, const Sensor& sensor, const std::vector<Hole>& holes, OutputFolder& folder);

  /// Appends a sample and the true state at its time.
  void append(const splinertia::StampedImuReading<double, std::chrono::nanoseconds>& reading, const TrueState& truth);
  /// Marks the next samples in imu.csv as inside a hole.
  void mark(const Hole& hole) { imu_csv_.comment(hole_comment(hole)); }
  /// The table of integration errors, if --csv is given.
  [[nodiscard]] splinertia::AtomicFile* table() { return table_csv_ ? &*table_csv_ : nullptr; }
  /// Completes the files and returns "imu.csv, groundtruth.csv and poses.tum".
  [[nodiscard]] std::string commit();

 private:
  OutputFolder& folder_;
  splinertia::EurocImuWriter imu_csv_;
  std::optional<splinertia::NpyImuWriter> imu_npy_;
  splinertia::EurocGroundtruthWriter groundtruth_csv_;
  splinertia::TumWriter poses_tum_;
  std::optional<splinertia::AtomicFile> imu_yaml_, gaps_csv_, table_csv_;
};
