// SPDX-License-Identifier: MIT
/// Cameras as calibration files describe them, by names and lists of numbers, and the way from and to camera models.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/detail/kalibr_layout.hpp>
#include <splinertia/detail/refuse.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace splinertia {

/// A camera as an entry of Kalibr's camchain.yaml, with its names and its order of numbers.
struct KalibrCamera {
  std::string camera_model;                    ///< pinhole, omni, ds, eucm; beyond Kalibr: equirectangular
  std::vector<double> intrinsics;              ///< own parameters of the model first, then fx, fy, cx, cy in pixels
  std::string distortion_model = "none";       ///< none, radtan, equidistant, fov; beyond Kalibr: radtan8
  std::vector<double> distortion_coeffs;       ///< k1, k2, p1, p2; k1, k2, k3, k4; w; k1, k2, p1, p2, k3, k4, k5, k6
  std::array<int, 2> resolution{0, 0};         ///< width and height in pixels
  std::optional<Eigen::Matrix4d> T_cam_imu{};  ///< takes coordinates of the IMU to the camera's, m: the inverse of T_BC
  std::optional<Eigen::Matrix4d> T_cn_cnm1{};  ///< takes coordinates of the camera before this one to this one's, m
  std::optional<double> timeshift_cam_imu{};   ///< time of the IMU's clock − time of the camera's clock, s
  std::string rostopic{};
  std::optional<double> line_delay{};  ///< from one row to the next, s
};

/// The names, parameters and nothing else of a camera model: the rest of the entry is for you to set.
template <CameraModel Model>
[[nodiscard]] KalibrCamera to_kalibr(const Model& model) {
  constexpr auto layout = detail::kalibr_layout<Model>();
  const auto p = model.parameters();
  KalibrCamera camera;
  camera.camera_model = std::string(layout.camera_model);
  camera.distortion_model = std::string(layout.distortion_model);
  for (int i = 0; i < layout.intrinsics; ++i) {
    camera.intrinsics.push_back(static_cast<double>(p[layout.index(i)]));
  }
  for (int i = layout.intrinsics; i < Model::parameter_count; ++i) {
    camera.distortion_coeffs.push_back(static_cast<double>(p[i]));
  }
  return camera;
}

/// Whether an entry names this model. `equi` stands for `equidistant`, the name of the model for that in files.
template <CameraModel Model>
[[nodiscard]] bool names_model(const KalibrCamera& camera) {
  constexpr auto layout = detail::kalibr_layout<Model>();
  const std::string_view distortion =
      camera.distortion_model == "equi" ? std::string_view("equidistant") : std::string_view(camera.distortion_model);
  return camera.camera_model == layout.camera_model && distortion == layout.distortion_model;
}

/// The camera model of an entry. Throws std::invalid_argument if the entry names another model or has another number
/// of parameters, and as the model's constructor does.
template <CameraModel Model>
[[nodiscard]] Model from_kalibr(const KalibrCamera& camera) {
  constexpr auto layout = detail::kalibr_layout<Model>();
  if (!names_model<Model>(camera)) {
    detail::refuse<std::invalid_argument>("KalibrCamera: camera_model is ", camera.camera_model,
                                          ", distortion_model is ", camera.distortion_model, ", expected ",
                                          layout.camera_model, " and ", layout.distortion_model);
  }
  const auto require_count = [](const char* list, std::size_t count, int expected) {
    if (count == static_cast<std::size_t>(expected)) return;
    detail::refuse<std::invalid_argument>("KalibrCamera: ", list, " has ", count, " numbers, expected ", expected,
                                          " for ", Model::name);
  };
  require_count("intrinsics", camera.intrinsics.size(), layout.intrinsics);
  require_count("distortion_coeffs", camera.distortion_coeffs.size(), Model::parameter_count - layout.intrinsics);
  Eigen::Matrix<typename Model::Scalar, Model::parameter_count, 1> p;
  for (int i = 0; i < layout.intrinsics; ++i) {
    p[layout.index(i)] = static_cast<typename Model::Scalar>(camera.intrinsics[static_cast<std::size_t>(i)]);
  }
  for (int i = layout.intrinsics; i < Model::parameter_count; ++i) {
    p[i] =
        static_cast<typename Model::Scalar>(camera.distortion_coeffs[static_cast<std::size_t>(i - layout.intrinsics)]);
  }
  return Model::from_parameters(p);
}

}  // namespace splinertia
