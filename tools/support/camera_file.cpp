// SPDX-License-Identifier: MIT
// The reading half of camera_file.hpp.
#include "support/camera_file.hpp"

#include <Eigen/Core>
#include <cmath>
#include <splinertia/camera/any_camera_model.hpp>
#include <splinertia/camera/kalibr_mounting.hpp>
#include <stdexcept>

#include "support/concat.hpp"
#include "support/yaml_reader.hpp"

using splinertia::KalibrCamera;

namespace {

/// Calls work(). If it rejects a value, the message names the place in the file.
void use(const YamlReader& place, const auto& work) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    place.fail(error.what());
  }
}

std::vector<double> numbers(const YamlReader& list) {
  std::vector<double> values;
  for (const YamlReader& element : list.elements()) values.push_back(element.number());
  return values;
}

std::array<int, 2> resolution(const YamlReader& file) {
  const YamlReader list = file["resolution"];
  const auto values = numbers(list);
  if (values.size() != 2) list.fail(concat("resolution has ", values.size(), " numbers, expected width and height"));
  for (const double value : values) {
    if (!(value >= 1 && value <= 1e6) || value != std::floor(value)) {
      list.fail(concat("resolution has ", value, ", expected a whole number of pixels from 1 to 1000000"));
    }
  }
  return {static_cast<int>(values[0]), static_cast<int>(values[1])};
}

/// Four lists of four numbers, which are a pose.
Eigen::Matrix4d pose(const YamlReader& place) {
  const auto rows = place.elements();
  if (rows.size() != 4) place.fail(concat(rows.size(), " rows, expected 4 of 4 numbers"));
  Eigen::Matrix4d T;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = numbers(rows[i]);
    if (row.size() != 4) rows[i].fail(concat(row.size(), " numbers in a row, expected 4"));
    T.row(static_cast<int>(i)) = Eigen::Map<const Eigen::RowVector4d>(row.data());
  }
  use(place, [&] { (void)splinertia::pose_of_matrix(T); });
  return T;
}

/// EuRoC's way of writing a pose: a list of 16 numbers, row by row.
Eigen::Matrix4d euroc_pose(const YamlReader& place) {
  place.expect_only({"cols", "rows", "data"});
  for (const char* key : {"cols", "rows"}) {
    if (place[key].number() != 4) place[key].fail(concat(key, " is ", place[key].text(), ", expected 4"));
  }
  const auto values = numbers(place["data"]);
  if (values.size() != 16) place["data"].fail(concat("data has ", values.size(), " numbers, expected 16"));
  const Eigen::Matrix4d T = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  use(place["data"], [&] { (void)splinertia::pose_of_matrix(T); });
  return T;
}

/// Model, distortion and size, which both formats have.
KalibrCamera read_model(const YamlReader& file, const char* coefficients) {
  KalibrCamera camera;
  camera.camera_model = file["camera_model"].text();
  camera.intrinsics = numbers(file["intrinsics"]);
  camera.distortion_model = file.has("distortion_model") ? file["distortion_model"].text() : "none";
  if (camera.distortion_model == "radial-tangential") camera.distortion_model = "radtan";
  if (camera.distortion_model == "equi") camera.distortion_model = "equidistant";
  if (file.has(coefficients)) camera.distortion_coeffs = numbers(file[coefficients]);
  camera.resolution = resolution(file);
  use(file["camera_model"], [&] { (void)splinertia::any_camera_model(camera); });
  return camera;
}

KalibrCamera read_kalibr_camera(const YamlReader& entry) {
  entry.expect_only({"camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "resolution", "T_cam_imu",
                     "T_imu_cam", "T_cn_cnm1", "timeshift_cam_imu", "rostopic", "line_delay", "cam_overlaps"});
  KalibrCamera camera = read_model(entry, "distortion_coeffs");
  if (entry.has("T_cam_imu") && entry.has("T_imu_cam")) {
    entry["T_imu_cam"].fail("T_imu_cam beside T_cam_imu, expected one of them");
  }
  if (entry.has("T_cam_imu")) camera.T_cam_imu = pose(entry["T_cam_imu"]);
  if (entry.has("T_imu_cam")) camera.T_cam_imu = splinertia::inverse_of_pose(pose(entry["T_imu_cam"]));
  if (entry.has("T_cn_cnm1")) camera.T_cn_cnm1 = pose(entry["T_cn_cnm1"]);
  if (entry.has("timeshift_cam_imu")) camera.timeshift_cam_imu = entry["timeshift_cam_imu"].number();
  if (entry.has("rostopic")) camera.rostopic = entry["rostopic"].text();
  if (entry.has("line_delay")) camera.line_delay = entry["line_delay"].number();
  return camera;
}

}  // namespace

std::vector<KalibrCamera> read_camchain(const std::filesystem::path& path) {
  const YamlReader file = YamlReader::open(path);
  if (!file.is_map() || !file.has("cam0")) file.fail("no cam0, expected Kalibr's entries cam0, cam1, ...");
  std::vector<KalibrCamera> cameras;
  std::set<std::string> names;
  const std::size_t count = file.keys().size();
  for (std::size_t i = 0; i < count; ++i) names.insert(concat("cam", i));
  file.expect_only(names);
  for (std::size_t i = 0; i < count; ++i) cameras.push_back(read_kalibr_camera(file[concat("cam", i)]));
  return cameras;
}

EurocCamera read_euroc_camera(const std::filesystem::path& path) {
  const YamlReader file = YamlReader::open(path);
  file.expect_only({"sensor_type", "comment", "T_BS", "rate_hz", "resolution", "camera_model", "intrinsics",
                    "distortion_model", "distortion_coefficients"});
  const YamlReader type = file["sensor_type"];
  if (type.text() != "camera") type.fail(concat("sensor_type is ", type.text(), ", expected camera"));
  EurocCamera euroc{read_model(file, "distortion_coefficients")};
  euroc.camera.T_cam_imu = splinertia::inverse_of_pose(euroc_pose(file["T_BS"]));
  euroc.rate = file["rate_hz"].number();
  if (!(euroc.rate > 0)) file["rate_hz"].fail(concat("rate_hz is ", euroc.rate, ", expected a number > 0"));
  if (file.has("comment")) euroc.comment = file["comment"].text();
  return euroc;
}
