// SPDX-License-Identifier: MIT
#include "../../tools/support/camera_file.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"

namespace test = splinertia::test;
using splinertia::KalibrCamera;
using splinertia::testing::message_of;

namespace {

Eigen::Matrix4d some_pose() {
  return (Eigen::Matrix4d() << 0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,  //
          0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,                           //
          -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,                       //
          0, 0, 0, 1)
      .finished();
}

KalibrCamera some_camera() {
  KalibrCamera camera{
      "pinhole", {458.654, 457.296, 367.215, 248.375}, "radtan", {-0.28340811, 0.07, 1.9e-4, 1.0 / 3e5}};
  camera.resolution = {752, 480};
  return camera;
}

/// One camera of each kind, with all that an entry can have.
std::vector<KalibrCamera> all_cameras() {
  std::vector<KalibrCamera> cameras(1, some_camera());
  const auto add = [&](const char* model, std::vector<double> intrinsics, const char* distortion,
                       std::vector<double> coefficients) {
    KalibrCamera camera = some_camera();
    camera.camera_model = model;
    camera.intrinsics = std::move(intrinsics);
    camera.distortion_model = distortion;
    camera.distortion_coeffs = std::move(coefficients);
    cameras.push_back(camera);
  };
  add("pinhole", {458, 457, 367, 248}, "none", {});
  add("pinhole", {458, 457, 367, 248}, "equidistant", {0.1, 0.02, 0.003, 0.0004});
  add("pinhole", {458, 457, 367, 248}, "radtan8", {0.1, 0.02, 0.003, 0.0004, 0.01, 0.2, 0.05, 0.006});
  add("pinhole", {458, 457, 367, 248}, "fov", {0.9});
  add("omni", {1.2, 458, 457, 367, 248}, "radtan", {-0.1, 0.02, 0.003, 0.0004});
  add("ds", {-0.2, 0.6, 458, 457, 367, 248}, "none", {});
  add("eucm", {0.6, 1.1, 458, 457, 367, 248}, "none", {});
  add("equirectangular", {752, 480}, "none", {});
  cameras[1].T_cam_imu = some_pose();
  cameras[1].T_cn_cnm1 = some_pose();
  cameras[1].timeshift_cam_imu = -5.3e-3;
  cameras[1].rostopic = "/cam 1/image: \"raw\"";
  cameras[2].line_delay = 29.4e-6;
  cameras[2].rostopic = "/cam1/image_raw";
  return cameras;
}

void check_same(const KalibrCamera& a, const KalibrCamera& b) {
  CHECK(a.camera_model == b.camera_model);
  CHECK(a.intrinsics == b.intrinsics);
  CHECK(a.distortion_model == b.distortion_model);
  CHECK(a.distortion_coeffs == b.distortion_coeffs);
  CHECK(a.resolution == b.resolution);
  CHECK(a.T_cam_imu == b.T_cam_imu);
  CHECK(a.T_cn_cnm1 == b.T_cn_cnm1);
  CHECK(a.timeshift_cam_imu == b.timeshift_cam_imu);
  CHECK(a.rostopic == b.rostopic);
  CHECK(a.line_delay == b.line_delay);
}

std::vector<KalibrCamera> camchain(const std::string& text) {
  const test::TemporaryDirectory folder;
  return read_camchain(folder.write("camchain.yaml", text));
}

EurocCamera euroc(const std::string& text) {
  const test::TemporaryDirectory folder;
  return read_euroc_camera(folder.write("sensor.yaml", text));
}

/// The message, without the folder.
std::string refusal(const auto& read, const std::string& text, const std::string& file) {
  const std::string error = test::error_of<std::runtime_error>([&] { (void)read(text); });
  const auto name = error.find(file);
  return name == std::string::npos ? error : error.substr(name);
}
std::string camchain_refusal(const std::string& text) { return refusal(camchain, text, "camchain.yaml"); }
std::string euroc_refusal(const std::string& text) { return refusal(euroc, text, "sensor.yaml"); }

const std::string kalibr =
    "cam0:\n  camera_model: pinhole\n  intrinsics: [458.654, 457.296, 367.215, 248.375]\n  distortion_model: radtan\n"
    "  distortion_coeffs: [-0.28, 0.07, 1.9e-04, 1.8e-05]\n  resolution: [752, 480]\n";

const std::string of_euroc =
    "# General sensor definitions.\nsensor_type: camera\ncomment: VI-Sensor cam0 (MT9M034)\n\nT_BS:\n  cols: 4\n"
    "  rows: 4\n  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,\n"
    "         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,\n"
    "        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,\n         0.0, 0.0, 0.0, 1.0]\n"
    "rate_hz: 20\nresolution: [752, 480]\ncamera_model: pinhole\n"
    "intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv\ndistortion_model: radial-tangential\n"
    "distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]\n";

std::string replaced(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

}  // namespace

TEST_CASE("A camchain is read to the same bits as written") {
  const auto cameras = all_cameras(), again = camchain(camchain_text(cameras));
  REQUIRE(again.size() == cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    CAPTURE(i);
    check_same(again[i], cameras[i]);
  }
}

TEST_CASE("A camchain is written as Kalibr writes it") {
  KalibrCamera camera = some_camera();
  camera.distortion_coeffs.back() = 2e-5;
  camera.T_cam_imu = Eigen::Matrix4d::Identity();
  camera.rostopic = "/cam0/image_raw";
  camera.timeshift_cam_imu = 0;
  CHECK(camchain_text({camera}) ==
        "cam0:\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, 0.0]\n  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n"
        "  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n"
        "  distortion_coeffs: [-0.28340811, 0.07, 0.00019, 2.0e-05]\n  distortion_model: radtan\n"
        "  intrinsics: [458.654, 457.296, 367.215, 248.375]\n  resolution: [752, 480]\n  rostopic: /cam0/image_raw\n"
        "  timeshift_cam_imu: 0.0\n");
}

TEST_CASE("A camchain of Kalibr and one of OpenVINS are read") {
  const auto cameras = camchain(kalibr + "  cam_overlaps: [1]\n  T_cam_imu:\n  - [0, 1, 0, 0.5]\n  - [-1, 0, 0, 0]\n" +
                                "  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n" + replaced(kalibr, "cam0", "cam1") +
                                "  T_imu_cam:\n    - [0, 1, 0, 0.5]\n    - [-1, 0, 0, 0]\n    - [0, 0, 1, 0]\n" +
                                "    - [0, 0, 0, 1]\n  timeshift_cam_imu: 0.01\n");
  REQUIRE(cameras.size() == 2);
  CHECK(cameras[0].intrinsics == std::vector{458.654, 457.296, 367.215, 248.375});
  CHECK((*cameras[0].T_cam_imu)(0, 3) == 0.5);
  CHECK_FALSE(cameras[0].timeshift_cam_imu);
  CHECK(*cameras[1].timeshift_cam_imu == 0.01);
  CHECK((*cameras[0].T_cam_imu * *cameras[1].T_cam_imu).isIdentity(0));
}

TEST_CASE("What a camchain is refused for: file, line and what was expected") {
  const auto refused = [](const std::string& part, const std::string& other) {
    return camchain_refusal(replaced(kalibr, part, other));
  };
  CHECK(camchain_refusal("cam1:\n  a: 1\n") == "camchain.yaml:1: no cam0, expected Kalibr's entries cam0, cam1, ...");
  CHECK(camchain_refusal(kalibr + "cam2:\n  a: 1\n") == "camchain.yaml:1: unknown cam2, expected cam0, cam1");
  CHECK(refused("pinhole", "pinhol") ==
        "camchain.yaml:2: KalibrCamera: camera_model is pinhol, distortion_model is radtan, expected one of pinhole "
        "none, pinhole radtan, pinhole radtan8, pinhole equidistant, pinhole fov, omni none, omni radtan, omni "
        "radtan8, ds none, eucm none, equirectangular none");
  CHECK(refused(", 248.375", "") ==
        "camchain.yaml:2: KalibrCamera: intrinsics has 3 numbers, expected 4 for pinhole-radtan");
  CHECK(refused("0.07, ", "0.07, 1, ") ==
        "camchain.yaml:2: KalibrCamera: distortion_coeffs has 5 numbers, expected 4 for pinhole-radtan");
  CHECK(refused("457.296", "-457") == "camchain.yaml:2: Pinhole: fy is -457, expected a finite number > 0");
  CHECK(refused("457.296", ".nan") == "camchain.yaml:3: .nan, expected a finite number");
  CHECK(refused("457.296", "x") == "camchain.yaml:3: x is not a number");
  CHECK(refused("480]", "0]") ==
        "camchain.yaml:6: resolution has 0, expected a whole number of pixels from 1 to 1000000");
  CHECK(refused("480]", "479.5]").starts_with("camchain.yaml:6: resolution has 479.5, expected a whole number"));
  CHECK(refused(", 480]", "]") == "camchain.yaml:6: resolution has 1 numbers, expected width and height");
  CHECK(refused("  intrinsics: [458.654, 457.296, 367.215, 248.375]\n", "") ==
        "camchain.yaml:2: no intrinsics, expected one");
  CHECK(refused("resolution", "resolutoin").starts_with("camchain.yaml:2: unknown resolutoin, expected T_cam_imu, "));
  CHECK(refused("resolution: [752, 480]", "resolution: [752, 480]\n  resolution: [752, 480]") ==
        "camchain.yaml:7: resolution is given twice");
  CHECK(camchain_refusal(kalibr + "  T_cam_imu: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1]]\n") ==
        "camchain.yaml:7: 3 rows, expected 4 of 4 numbers");
  CHECK(camchain_refusal(kalibr +
                         "  T_cam_imu:\n  - [1, 0, 0, 0]\n  - [0, 1, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n") ==
        "camchain.yaml:9: 3 numbers in a row, expected 4");
  CHECK(camchain_refusal(kalibr + "  T_cam_imu: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]\n")
            .starts_with("camchain.yaml:7: pose_of_matrix: a rotation has the determinant -1"));
}

TEST_CASE("EuRoC's own file is read") {
  const EurocCamera camera = euroc(of_euroc);
  CHECK(camera.camera.camera_model == "pinhole");
  CHECK(camera.camera.distortion_model == "radtan");
  CHECK(camera.camera.distortion_coeffs == std::vector{-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
  CHECK(camera.camera.resolution == std::array{752, 480});
  CHECK(camera.rate == 20);
  CHECK(camera.comment == "VI-Sensor cam0 (MT9M034)");
  CHECK((*camera.camera.T_cam_imu * some_pose()).isIdentity(1e-9));
}

TEST_CASE("What is written for EuRoC is read again") {
  for (KalibrCamera camera : all_cameras()) {
    camera.T_cam_imu = some_pose();
    camera.T_cn_cnm1.reset();
    camera.timeshift_cam_imu.reset();
    camera.line_delay.reset();
    camera.rostopic.clear();
    const EurocCamera again = euroc(euroc_camera_text({camera, 29.97, "a \"comment\": #1"}));
    CHECK((*again.camera.T_cam_imu - some_pose()).cwiseAbs().maxCoeff() < 1e-12);  // the file's rotation has 12 digits
    CHECK(again.rate == 29.97);
    CHECK(again.comment == "a \"comment\": #1");
    camera.T_cam_imu = again.camera.T_cam_imu;
    check_same(again.camera, camera);
  }
}

TEST_CASE("What a sensor.yaml is refused for") {
  const auto refused = [](const std::string& part, const std::string& other) {
    return euroc_refusal(replaced(of_euroc, part, other));
  };
  CHECK(refused(": camera", ": imu") == "sensor.yaml:2: sensor_type is imu, expected camera");
  CHECK(refused("cols: 4", "cols: 3") == "sensor.yaml:6: cols is 3, expected 4");
  CHECK(refused(", 1.0]", "]") == "sensor.yaml:8: data has 15 numbers, expected 16");
  CHECK(refused("-0.999880929698", "0.99").starts_with("sensor.yaml:8: pose_of_matrix: "));
  CHECK(refused("20\n", "0\n") == "sensor.yaml:12: rate_hz is 0, expected a number > 0");
  CHECK(refused("radial-tangential", "radial")
            .find("sensor.yaml:14: KalibrCamera: camera_model is pinhole, "
                  "distortion_model is radial, expected one of") == 0);
}

TEST_CASE("OpenCV's FileStorage gets its matrices") {
  auto cameras = all_cameras();
  cameras[0].distortion_coeffs.back() = 2e-5;
  CHECK(opencv_camera_text(cameras[0]) ==
        "%YAML:1.0\n---\nimage_width: 752\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
        "   dt: d\n   data: [ 458.654, 0.0, 367.215, 0.0, 457.296, 248.375, 0.0, 0.0, 1.0 ]\n"
        "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n"
        "   data: [ -0.28340811, 0.07, 0.00019, 2.0e-05 ]\n");
  CHECK(opencv_camera_text(cameras[1]).find("data: [ 0.0, 0.0, 0.0, 0.0 ]") != std::string::npos);
  CHECK(opencv_camera_text(cameras[2]).ends_with("data: [ 0.1, 0.02, 0.003, 0.0004 ]\nfisheye_model: 1\n"));
  CHECK(opencv_camera_text(cameras[3]).find("cols: 8") != std::string::npos);
  CHECK(opencv_camera_text(cameras[5]).ends_with("data: [ -0.1, 0.02, 0.003, 0.0004 ]\nxi: 1.2\n"));
  CHECK(message_of([&] { return opencv_camera_text(cameras[6]); }) ==
        "OpenCV has no model ds-none, expected pinhole with none, radtan, radtan8 or equidistant, or omni with radtan");
}

TEST_CASE("COLMAP's pixels begin at the corner") {
  auto cameras = all_cameras();
  cameras[0].distortion_coeffs.back() = 2e-5;
  CHECK(colmap_camera_line(cameras[0], 7) ==
        "7 OPENCV 752 480 458.654 457.296 367.715 248.875 -0.28340811 0.07 0.00019 2.0e-05\n");
  CHECK(colmap_camera_line(cameras[1]) == "1 PINHOLE 752 480 458.0 457.0 367.5 248.5\n");
  CHECK(colmap_camera_line(cameras[2]) == "1 OPENCV_FISHEYE 752 480 458.0 457.0 367.5 248.5 0.1 0.02 0.003 0.0004\n");
  CHECK(colmap_camera_line(cameras[3]) ==
        "1 FULL_OPENCV 752 480 458.0 457.0 367.5 248.5 0.1 0.02 0.003 0.0004 0.01 0.2 0.05 0.006\n");
  CHECK(colmap_camera_line(cameras[4]) == "1 FOV 752 480 458.0 457.0 367.5 248.5 0.9\n");
  CHECK(colmap_camera_line(cameras[7]) == "1 EUCM 752 480 458.0 457.0 367.5 248.5 0.6 1.1\n");
  CHECK(message_of([&] { return colmap_camera_line(cameras[5]); }) ==
        "COLMAP has no model omni-radtan, expected pinhole with none, radtan, radtan8, equidistant or fov, or eucm");
}

TEST_CASE("What cannot be read is not written") {
  KalibrCamera camera = some_camera();
  CHECK(message_of([&] { return euroc_camera_text({camera}); }) == "KalibrCamera: no T_cam_imu, expected one");
  camera.resolution = {752, 0};
  CHECK(message_of([&] { return camchain_text({camera}); }) ==
        "KalibrCamera: resolution is 0, expected 1 to 1000000 pixels");
  camera = some_camera();
  camera.line_delay = std::numeric_limits<double>::infinity();
  CHECK(message_of([&] { return camchain_text({camera}); }) ==
        "KalibrCamera: line_delay is inf, expected a finite number");
  camera = some_camera();
  camera.intrinsics[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(message_of([&] { return colmap_camera_line(camera); }) == "Pinhole: fx is nan, expected a finite number > 0");
}
