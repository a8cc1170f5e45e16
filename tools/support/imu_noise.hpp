// SPDX-License-Identifier: MIT
// The noise of an IMU as estimators use it: four densities, read from and written to the files of Kalibr, OpenVINS,
// VINS, ORB-SLAM3 and GTSAM.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "support/any_error_model.hpp"

/// The content of these files: densities of continuous time, and the intrinsics from a calibration of Kalibr
/// (scale-misalignment) or OpenVINS.
struct ImuNoise {
  double gyro_noise_density = 0;                        ///< rad/s/√Hz
  double gyro_random_walk = 0;                          ///< rad/s²/√Hz
  double accel_noise_density = 0;                       ///< m/s²/√Hz
  double accel_random_walk = 0;                         ///< m/s³/√Hz
  double update_rate = 200;                             ///< Hz
  std::string topic = "/imu0";                          ///< of the ROS bag
  std::optional<Eigen::Matrix3d> gyro_misalignment{};   ///< Kalibr's M·C_gyro_i, OpenVINS' Tw·R_IMUtoGYRO
  std::optional<Eigen::Matrix3d> g_sensitivity{};       ///< Kalibr's A·C_gyro_i, OpenVINS' Tg, rad/s per m/s²
  std::optional<Eigen::Matrix3d> accel_misalignment{};  ///< Kalibr's M, OpenVINS' Ta·R_IMUtoACC
};

/// The estimator that a file is for.
enum class Estimator { kalibr, openvins, vins, orbslam3, gtsam };
inline constexpr std::array<Estimator, 5> estimators{Estimator::kalibr, Estimator::openvins, Estimator::vins,
                                                     Estimator::orbslam3, Estimator::gtsam};

/// The name in options: kalibr, openvins, vins (VINS-Mono and VINS-Fusion), orbslam3, gtsam.
[[nodiscard]] std::string_view option_name(Estimator estimator);

/// Kalibr, OpenVINS, VINS, ORB-SLAM3, GTSAM.
[[nodiscard]] std::string_view name(Estimator estimator);

/// imu.yaml, openvins_imu.yaml, vins_imu.yaml, orbslam3_imu.yaml, gtsam_imu.yaml.
[[nodiscard]] std::string_view file_name(Estimator estimator);

/// The text of an estimator's file: the given comments, a line each, then a comment on the units and on the inflation
/// that the estimator's own documentation recommends, then the values. The values are not inflated. Control characters
/// in comments are written as escapes. The intrinsics are those of an ideal IMU. Units by estimator:
///   Kalibr, OpenVINS, ORB-SLAM3: the densities.
///   VINS: acc_n, gyr_n = density·√rate; acc_w, gyr_w = random walk·√rate, because VINS adds w·Δt to a bias.
///   GTSAM: the squares of the densities, each times the identity.
[[nodiscard]] std::string imu_noise_text(Estimator estimator, const ImuNoise& noise,
                                         const std::vector<std::string>& comments = {});

/// Reads a file of any of these estimators, told apart by its keys. `rate` (Hz) is used where the file has no
/// update_rate: for VINS, whose values need one, and for GTSAM. Throws std::runtime_error naming file, line and what
/// was expected.
[[nodiscard]] ImuNoise read_imu_noise(const std::filesystem::path& path, std::optional<double> rate = std::nullopt);

/// The error terms of this noise, in Kalibr's order: misalignment, g-sensitivity, random walk, white noise.
[[nodiscard]] AnyImu errors_of(const ImuNoise& noise);

/// The densities of these errors for estimators: white noise, correlated between axes or not, and random walks, each the
/// root of the sum of squares on the noisiest axis. Nothing if one of the four is zero, which estimators reject.
[[nodiscard]] std::optional<ImuNoise> imu_noise_of(const AnyImu& imu, double rate);
