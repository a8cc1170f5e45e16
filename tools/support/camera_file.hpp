// SPDX-License-Identifier: MIT
// Files that describe cameras: Kalibr's camchain.yaml and EuRoC's sensor.yaml in and out, OpenCV's and COLMAP's out.
#pragma once

#include <filesystem>
#include <splinertia/camera/kalibr_camera.hpp>
#include <string>
#include <vector>

/// The cameras of a camchain.yaml: cam0, cam1, …. OpenVINS' T_imu_cam is taken, too. Throws std::runtime_error with
/// file:line for an entry that is unknown, missing, duplicated, not finite or of the wrong length, for unknown names,
/// and for what the model's constructor rejects.
[[nodiscard]] std::vector<splinertia::KalibrCamera> read_camchain(const std::filesystem::path& path);

/// The text of such a file. Numbers are read back to the same bits. Models that Kalibr does not have (radtan8,
/// equirectangular) are written under these names. Throws std::invalid_argument for a camera that read_camchain() would
/// reject.
[[nodiscard]] std::string camchain_text(const std::vector<splinertia::KalibrCamera>& cameras);

/// The camera of a sensor.yaml.
struct EurocCamera {
  splinertia::KalibrCamera camera;  ///< with T_cam_imu, the inverse of T_BS
  double rate = 20;                 ///< Hz
  std::string comment{};
};

/// The camera of mav0/cam0/sensor.yaml of a dataset in EuRoC's format. Throws as read_camchain() does.
[[nodiscard]] EurocCamera read_euroc_camera(const std::filesystem::path& path);

/// The text of such a file, where camera.T_cam_imu is required. Throws std::invalid_argument as camchain_text() does.
[[nodiscard]] std::string euroc_camera_text(const EurocCamera& camera);

/// The text of a YAML file for OpenCV's FileStorage, with the names that OpenCV's calibration program uses:
/// image_width, image_height, camera_matrix, distortion_coefficients, fisheye_model; and xi for cv::omnidir. Throws
/// std::invalid_argument for models other than pinhole with none, radtan, radtan8 or equidistant, and omni with radtan.
[[nodiscard]] std::string opencv_camera_text(const splinertia::KalibrCamera& camera);

/// The line of COLMAP's cameras.txt: CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]. COLMAP's pixel (0, 0) is the upper left
/// corner of the image, ours the centre of the upper left pixel: cx and cy are larger by 0.5 there. Throws
/// std::invalid_argument for models other than pinhole with none, radtan, radtan8, equidistant or fov, and eucm.
[[nodiscard]] std::string colmap_camera_line(const splinertia::KalibrCamera& camera, int id = 1);
