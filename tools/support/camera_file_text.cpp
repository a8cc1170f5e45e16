// SPDX-License-Identifier: MIT
// The writing half of camera_file.hpp.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/camera/any_camera_model.hpp>
#include <splinertia/camera/kalibr_mounting.hpp>
#include <stdexcept>
#include <utility>

#include "support/camera_file.hpp"
#include "support/concat.hpp"
#include "support/yaml_text.hpp"

using splinertia::KalibrCamera;

namespace {

std::string list(const auto& values, const char* separator = ", ") {
  std::string text;
  for (const double value : values) text += concat(text.empty() ? "" : separator, yaml_number(value));
  return text;
}

std::string size(const KalibrCamera& camera) {
  return concat("[", camera.resolution[0], ", ", camera.resolution[1], "]");
}

std::string rows(const Eigen::Matrix4d& T) {
  std::string text;
  for (int i = 0; i < 4; ++i) text += concat("  - [", list(Eigen::RowVector4d(T.row(i))), "]\n");
  return text;
}

void require(bool good, const char* name, double value, const char* expected) {
  if (!good) throw std::invalid_argument(concat("KalibrCamera: ", name, " is ", value, ", expected ", expected));
}

/// Throws std::invalid_argument for what a reader would reject.
void check(const KalibrCamera& camera) {
  (void)splinertia::any_camera_model(camera);
  for (const int pixels : camera.resolution) {
    require(pixels >= 1 && pixels <= 1000000, "resolution", pixels, "1 to 1000000 pixels");
  }
  if (camera.T_cam_imu) (void)splinertia::pose_of_matrix(*camera.T_cam_imu);
  if (camera.T_cn_cnm1) (void)splinertia::pose_of_matrix(*camera.T_cn_cnm1);
  const std::pair<const char*, std::optional<double>> times[]{{"timeshift_cam_imu", camera.timeshift_cam_imu},
                                                              {"line_delay", camera.line_delay}};
  for (const auto& [name, time] : times)
    require(!time || std::isfinite(*time), name, time.value_or(0), "a finite number");
}

/// pinhole-radtan.
std::string full_name(const KalibrCamera& camera) { return concat(camera.camera_model, '-', camera.distortion_model); }

[[noreturn]] void refuse(const KalibrCamera& camera, const char* owner, const char* expected) {
  throw std::invalid_argument(concat(owner, " has no model ", full_name(camera), ", expected ", expected));
}

std::string opencv_matrix(const char* name, int rows, const std::vector<double>& values) {
  return concat(name, ": !!opencv-matrix\n   rows: ", rows,
                "\n   cols: ", values.size() / static_cast<std::size_t>(rows), "\n   dt: d\n   data: [ ", list(values),
                " ]\n");
}

}  // namespace

std::string camchain_text(const std::vector<KalibrCamera>& cameras) {
  std::string text;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const KalibrCamera& camera = cameras[i];
    check(camera);
    text += concat("cam", i, ":\n");
    if (camera.T_cam_imu) text += "  T_cam_imu:\n" + rows(*camera.T_cam_imu);
    if (camera.T_cn_cnm1) text += "  T_cn_cnm1:\n" + rows(*camera.T_cn_cnm1);
    text +=
        concat("  camera_model: ", camera.camera_model, "\n  distortion_coeffs: [", list(camera.distortion_coeffs),
               "]\n  distortion_model: ", camera.distortion_model, "\n  intrinsics: [", list(camera.intrinsics), "]\n");
    if (camera.line_delay) text += concat("  line_delay: ", yaml_number(*camera.line_delay), "\n");
    text += concat("  resolution: ", size(camera), "\n");
    if (!camera.rostopic.empty()) text += concat("  rostopic: ", yaml_string(camera.rostopic), "\n");
    if (camera.timeshift_cam_imu) {
      text += concat("  timeshift_cam_imu: ", yaml_number(*camera.timeshift_cam_imu), "\n");
    }
  }
  return text;
}

std::string euroc_camera_text(const EurocCamera& euroc) {
  const KalibrCamera& camera = euroc.camera;
  check(camera);
  require(euroc.rate > 0 && std::isfinite(euroc.rate), "rate", euroc.rate, "a finite number > 0");
  if (!camera.T_cam_imu) throw std::invalid_argument("KalibrCamera: no T_cam_imu, expected one");
  const Eigen::Matrix4d T_BS = splinertia::inverse_of_pose(*camera.T_cam_imu);
  std::string data;
  for (int i = 0; i < 4; ++i) {
    data += concat(i == 0 ? "" : ",\n         ", list(Eigen::RowVector4d(T_BS.row(i))));
  }
  const std::string distortion = camera.distortion_model == "radtan" ? "radial-tangential" : camera.distortion_model;
  return concat("# General sensor definitions.\nsensor_type: camera\ncomment: ", yaml_string(euroc.comment),
                "\n\n# Sensor extrinsics wrt. the body-frame.\nT_BS:\n  cols: 4\n  rows: 4\n  data: [", data,
                "]\n\n# Camera specific definitions.\nrate_hz: ", yaml_number(euroc.rate),
                "\nresolution: ", size(camera), "\ncamera_model: ", camera.camera_model, "\nintrinsics: [",
                list(camera.intrinsics), "]\ndistortion_model: ", distortion, "\ndistortion_coefficients: [",
                list(camera.distortion_coeffs), "]\n");
}

std::string opencv_camera_text(const KalibrCamera& camera) {
  check(camera);
  const std::string name = full_name(camera);
  const bool omni = name == "omni-radtan", fisheye = name == "pinhole-equidistant", none = name == "pinhole-none";
  if (!omni && !fisheye && !none && name != "pinhole-radtan" && name != "pinhole-radtan8") {
    refuse(camera, "OpenCV", "pinhole with none, radtan, radtan8 or equidistant, or omni with radtan");
  }
  const double* const f = camera.intrinsics.data() + (omni ? 1 : 0);
  std::string text =
      concat("%YAML:1.0\n---\nimage_width: ", camera.resolution[0], "\nimage_height: ", camera.resolution[1], "\n");
  text += opencv_matrix("camera_matrix", 3, {f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1});
  text += opencv_matrix("distortion_coefficients", 1, none ? std::vector<double>(4, 0.0) : camera.distortion_coeffs);
  if (fisheye) text += "fisheye_model: 1\n";
  if (omni) text += concat("xi: ", yaml_number(camera.intrinsics[0]), "\n");
  return text;
}

std::string colmap_camera_line(const KalibrCamera& camera, int id) {
  check(camera);
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> models{
      {{"pinhole-none", "PINHOLE"},
       {"pinhole-radtan", "OPENCV"},
       {"pinhole-radtan8", "FULL_OPENCV"},
       {"pinhole-equidistant", "OPENCV_FISHEYE"},
       {"pinhole-fov", "FOV"},
       {"eucm-none", "EUCM"}}};
  const std::string name = full_name(camera);
  for (const auto& [ours, theirs] : models) {
    if (name != ours) continue;
    const std::size_t own = camera.intrinsics.size() - 4;  // COLMAP has them behind cy
    std::vector<double> p(camera.intrinsics.begin() + static_cast<std::ptrdiff_t>(own), camera.intrinsics.end());
    p[2] += 0.5;
    p[3] += 0.5;
    p.insert(p.end(), camera.intrinsics.begin(), camera.intrinsics.begin() + static_cast<std::ptrdiff_t>(own));
    p.insert(p.end(), camera.distortion_coeffs.begin(), camera.distortion_coeffs.end());
    return concat(id, ' ', theirs, ' ', camera.resolution[0], ' ', camera.resolution[1], ' ', list(p, " "), "\n");
  }
  refuse(camera, "COLMAP", "pinhole with none, radtan, radtan8, equidistant or fov, or eucm");
}
