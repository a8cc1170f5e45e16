// SPDX-License-Identifier: MIT
// Kalibr's imu.yaml, in and out.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "support/any_error_model.hpp"

/// What a Kalibr imu.yaml says: densities of continuous time, and what a calibration with the model scale-misalignment
/// adds to it. https://github.com/ethz-asl/kalibr/wiki/yaml-formats
struct KalibrImu {
  double gyro_noise_density = 0;   ///< rad/s/√Hz
  double gyro_random_walk = 0;     ///< rad/s²/√Hz
  double accel_noise_density = 0;  ///< m/s²/√Hz
  double accel_random_walk = 0;    ///< m/s³/√Hz
  double update_rate = 200;        ///< Hz
  std::string topic = "/imu0";
  std::optional<Eigen::Matrix3d> gyro_misalignment{};   ///< Kalibr's M·C_gyro_i
  std::optional<Eigen::Matrix3d> g_sensitivity{};       ///< Kalibr's A·C_gyro_i
  std::optional<Eigen::Matrix3d> accel_misalignment{};  ///< Kalibr's M
};

/// Reads one: as given to Kalibr, or the first sensor (imu0) of one that Kalibr wrote. Throws std::runtime_error naming
/// file, line and what was expected.
[[nodiscard]] KalibrImu read_kalibr(const std::filesystem::path& path);

/// Its errors as terms, in Kalibr's order: misalignment, g-sensitivity, random walk, white noise.
[[nodiscard]] AnyImu errors_of(const KalibrImu& imu);

/// What an estimator should be told of these errors: white noise and random walks, of the noisiest axis, added up in
/// squares; nothing if one of the four is zero, which Kalibr refuses.
[[nodiscard]] std::optional<KalibrImu> kalibr_noise(const AnyImu& imu, double rate);

/// The noise of one as a file that Kalibr, and the estimators that follow it, read.
[[nodiscard]] std::string kalibr_text(const KalibrImu& imu);
