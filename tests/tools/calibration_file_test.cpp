// SPDX-License-Identifier: MIT
#include "../../tools/support/calibration_file.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

CalibratedImu<double> some_calibration() {
  CalibratedImu<double> imu{};
  imu.calibration.gyro_bias = {0.1, -1.0 / 3, 2e-300};
  imu.calibration.accel_bias = {0.0, 4, -0.7};
  imu.calibration.gravity = {0.01, -0.02, -9.80665};
  imu.calibration.mounting = {GroupTraits<Sophus::SO3d>::exp({1, -2, 0.5}), {0.05, -0.12, 1e-3}};
  imu.calibration.time_offset = -0.0123456789;
  imu.standard_deviation = {{1e-5, 2e-5, infinity}, {0.01, 0.02, 0.03}, {0, 0, 0}, {1e-4, 2e-4}, infinity};
  return imu;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("What is written is read to the same bits") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "calibration.yaml";
  const auto imu = some_calibration();
  write_calibration(path, imu);
  CHECK(folder.files() == 1);
  const auto read = read_calibration(path);
  CHECK(read.calibration.gyro_bias == imu.calibration.gyro_bias);
  CHECK(read.calibration.accel_bias == imu.calibration.accel_bias);
  CHECK(read.calibration.gravity == imu.calibration.gravity);
  CHECK(read.calibration.mounting.p_BI == imu.calibration.mounting.p_BI);
  CHECK(read.calibration.mounting.R_BI.unit_quaternion().coeffs() ==
        imu.calibration.mounting.R_BI.unit_quaternion().coeffs());
  CHECK(read.calibration.time_offset == imu.calibration.time_offset);
  CHECK(read.standard_deviation.gyro_bias == imu.standard_deviation.gyro_bias);
  CHECK(read.standard_deviation.accel_bias == imu.standard_deviation.accel_bias);
  CHECK(read.standard_deviation.lever_arm == imu.standard_deviation.lever_arm);
  CHECK(read.standard_deviation.gravity_direction == imu.standard_deviation.gravity_direction);
  CHECK(read.standard_deviation.time_offset == infinity);
  CHECK(calibration_text(read) == calibration_text(imu));
}

TEST_CASE("Units of data sheets may be given, and a quaternion with four digits") {
  const test::TemporaryDirectory folder;
  CalibratedImu<double> imu{};
  const std::string text = calibration_text(imu);
  auto changed = replaced(text, "accel_bias: [0, 0, 0]", "accel_bias: [1 mg, 0, 0]");
  changed = replaced(changed, "{w: 1, x: 0, y: 0, z: 0}", "{w: 0.7071, x: 0, y: 0.7071, z: 0}");
  const auto read = read_calibration(folder.write("a.yaml", changed)).calibration;
  CHECK_THAT(read.accel_bias.x(), WithinAbs(9.80665e-3, 1e-15));
  CHECK_THAT(read.mounting.R_BI.unit_quaternion().w(), WithinAbs(std::sqrt(0.5), 1e-15));
}

TEST_CASE("Numbers that no reader would take are not written") {
  const test::TemporaryDirectory folder;
  const auto refused = [&](const auto& change) {
    auto imu = some_calibration();
    change(imu);
    const auto error = test::error_of<std::invalid_argument>([&] { write_calibration(folder / "bad.yaml", imu); });
    CHECK(folder.files() == 0);
    return error;
  };
  CHECK(refused([](auto& imu) { imu.calibration.gyro_bias[1] = std::numeric_limits<double>::quiet_NaN(); }) ==
        "calibration: gyro_bias is nan, expected a finite number");
  CHECK(refused([](auto& imu) { imu.calibration.time_offset = infinity; }) ==
        "calibration: time_offset is inf, expected a finite number");
  CHECK(refused([](auto& imu) { imu.standard_deviation.lever_arm[0] = -1; }) ==
        "calibration: lever_arm_standard_deviation is -1, expected a number >= 0");
}

TEST_CASE("A calibration file is read strictly, and the line is named") {
  const test::TemporaryDirectory folder;
  const std::string text = calibration_text(some_calibration());
  const auto error = [&](const std::string& content) {
    const auto path = folder.write("c.yaml", content);
    std::string said = test::error_of<std::runtime_error>([&] { (void)read_calibration(path); });
    const auto at = said.find("c.yaml");
    return at == std::string::npos ? said : said.substr(at);
  };
  const auto after = [&](const char* from, const char* to) { return error(replaced(text, from, to)); };
  CHECK(error(text).empty());
  CHECK_THAT(after("gyro_bias:", "gyro_biases:"), StartsWith("c.yaml:6: unknown gyro_biases, expected accel_bias, "));
  CHECK_THAT(error(replaced(text, "time_offset: -0.0123456789", "# ")), StartsWith("c.yaml:6: no time_offset"));
  CHECK(error(text + "lever_arm: [0, 0, 0]\n") == "c.yaml:17: lever_arm is given twice");
  CHECK(after("[0, 4, -0.7]", "[0, 4]") == "c.yaml:8: accel_bias: 2 numbers, expected 3");
  CHECK(after("[0, 4, -0.7]", "4") == "c.yaml:8: expected a list");
  CHECK(after("[0, 4, -0.7]", "[0, .nan, 1]") == "c.yaml:8: .nan, expected a finite number");
  CHECK(after("[0, 4, -0.7]", "[0, .inf, 1]") == "c.yaml:8: .inf, expected a finite number");
  CHECK(after("[0, 4, -0.7]", "[0, four, 1]") == "c.yaml:8: four is not a number");
  CHECK_THAT(after("[0, 4, -0.7]", "[0, 4 apples, 1]"), StartsWith("c.yaml:8: 4 apples: unknown unit apples"));
  CHECK(after("[0.01, 0.02, 0.03]", "[0.01, -0.02, 0.03]") ==
        "c.yaml:9: accel_bias_standard_deviation: -0.02, expected a number >= 0");
  CHECK(after("deviation: .inf", "deviation: .nan") == "c.yaml:16: .nan, expected a finite number");
  CHECK_THAT(after("{w: ", "{a: 1, w: "), StartsWith("c.yaml:14: unknown a, expected w, x, y, z"));
  CHECK_THAT(after("{w: ", "{w: 3"), StartsWith("c.yaml:14: rotation: a quaternion of norm "));
  CHECK_THAT(after("[", "[["), StartsWith("c.yaml:"));
  CHECK(error("") == "c.yaml: expected a map, `key: value`");
  CHECK_THAT(test::error_of<std::runtime_error>([&] { (void)read_calibration(folder / "none.yaml"); }),
             EndsWith("none.yaml: cannot read this file"));
}
