// SPDX-License-Identifier: MIT
#include "support/calibration_file.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/group/sophus.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/number_text.hpp>
#include <stdexcept>
#include <vector>

#include "support/concat.hpp"
#include "support/yaml_reader.hpp"

using namespace splinertia;

namespace {

const char* const header =
    "# Calibration of an IMU in the body whose poses a trajectory has. The reading at the IMU's time t is\n"
    "#   gyro  = R_BI^T w + gyro_bias\n"
    "#   accel = R_BI^T (R_WB^T (a - gravity) + dw/dt x lever_arm + w x (w x lever_arm)) + accel_bias\n"
    "# of the body's motion at t + time_offset. Standard deviations are one sigma: 0 for what was not estimated, .inf\n"
    "# for what the motion does not determine.\n";

/// The text of a number that reads back to the same bits.
std::string number_text(double value) {
  char text[number_text_size];
  return {text, static_cast<std::size_t>(real_to_chars(text, value) - text)};
}

std::string checked(const char* key, double value, bool may_be_infinite) {
  if (may_be_infinite && value == std::numeric_limits<double>::infinity()) return ".inf";
  if (!std::isfinite(value) || (may_be_infinite && value < 0)) {
    throw std::invalid_argument(concat("calibration: ", key, " is ", value, ", expected ",
                                       may_be_infinite ? "a number >= 0" : "a finite number"));
  }
  return number_text(value);
}

void append_list(std::string& text, const char* key, const auto& values, bool may_be_infinite, const char* unit) {
  text += concat(key, ": [");
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    text += (i == 0 ? "" : ", ") + checked(key, values[i], may_be_infinite);
  }
  text += concat("]  # ", unit, '\n');
}

double deviation_of(const YamlReader& entry, const char* key) {
  if (entry.text() == ".inf") return std::numeric_limits<double>::infinity();
  const double value = entry.number();
  if (value < 0) entry.fail(concat(key, ": ", value, ", expected a number >= 0"));
  return value;
}

template <int Size, typename Read>
Eigen::Matrix<double, Size, 1> list(const YamlReader& file, const char* key, const Read& read) {
  const YamlReader entry = file[key];
  const std::vector<YamlReader> elements = entry.elements();
  if (elements.size() != std::size_t(Size)) {
    entry.fail(concat(key, ": ", elements.size(), " numbers, expected ", Size));
  }
  Eigen::Matrix<double, Size, 1> values;
  for (int i = 0; i < Size; ++i) values[i] = read(elements[static_cast<std::size_t>(i)]);
  return values;
}

Eigen::Vector3d vector(const YamlReader& file, const char* key) {
  return list<3>(file, key, [](const YamlReader& element) { return element.number(); });
}

template <int Size>
Eigen::Matrix<double, Size, 1> deviations(const YamlReader& file, const char* key) {
  return list<Size>(file, key, [key](const YamlReader& element) { return deviation_of(element, key); });
}

Sophus::SO3d rotation_of(const YamlReader& entry) {
  entry.expect_only({"w", "x", "y", "z"});
  const Eigen::Quaterniond q(entry["w"].number(), entry["x"].number(), entry["y"].number(), entry["z"].number());
  const double norm = q.norm();
  if (!(std::abs(norm - 1) <= 1e-3)) {
    entry.fail(concat("rotation: a quaternion of norm ", norm, ", expected 1 to within 0.001"));
  }
  // A unit quaternion (to rounding) is not normalized, so that a written file reads back to the same bits.
  return rotation_from_unit_quaternion<double>(std::abs(norm - 1) < 1e-15 ? q : q.normalized());
}

}  // namespace

std::string calibration_text(const CalibratedImu<double>& imu) {
  const ImuCalibration<double>& c = imu.calibration;
  const auto& deviation = imu.standard_deviation;
  const Eigen::Quaterniond& q = c.mounting.R_BI.unit_quaternion();
  std::string text = header;
  append_list(text, "gyro_bias", c.gyro_bias, false, "rad/s");
  append_list(text, "gyro_bias_standard_deviation", deviation.gyro_bias, true, "rad/s");
  append_list(text, "accel_bias", c.accel_bias, false, "m/s^2");
  append_list(text, "accel_bias_standard_deviation", deviation.accel_bias, true, "m/s^2");
  append_list(text, "gravity", c.gravity, false, "m/s^2, acceleration of free fall in the world");
  append_list(text, "gravity_direction_standard_deviation", deviation.gravity_direction, true,
              "rad, in two directions perpendicular to it");
  append_list(text, "lever_arm", c.mounting.p_BI, false, "m, p_BI: the IMU in the body");
  append_list(text, "lever_arm_standard_deviation", deviation.lever_arm, true, "m");
  text += concat("rotation: {w: ", checked("rotation", q.w(), false), ", x: ", checked("rotation", q.x(), false),
                 ", y: ", checked("rotation", q.y(), false), ", z: ", checked("rotation", q.z(), false),
                 "}  # R_BI: axes of the IMU in those of the body\n");
  text += concat("time_offset: ", checked("time_offset", c.time_offset, false),
                 "  # s: time of the trajectory's clock - time of the IMU's\n");
  text +=
      concat("time_offset_standard_deviation: ", checked("time_offset_standard_deviation", deviation.time_offset, true),
             "  # s\n");
  return text;
}

void write_calibration(const std::filesystem::path& path, const CalibratedImu<double>& imu) {
  const std::string text = calibration_text(imu);
  AtomicFile file(path);
  file.append(text);
  file.commit();
}

CalibratedImu<double> read_calibration(const std::filesystem::path& path) {
  const YamlReader file = YamlReader::open(path);
  file.expect_only({"gyro_bias", "gyro_bias_standard_deviation", "accel_bias", "accel_bias_standard_deviation",
                    "gravity", "gravity_direction_standard_deviation", "lever_arm", "lever_arm_standard_deviation",
                    "rotation", "time_offset", "time_offset_standard_deviation"});
  CalibratedImu<double> imu{};
  imu.converged = true;
  ImuCalibration<double>& c = imu.calibration;
  c.gyro_bias = vector(file, "gyro_bias");
  c.accel_bias = vector(file, "accel_bias");
  c.gravity = vector(file, "gravity");
  c.mounting = {rotation_of(file["rotation"]), vector(file, "lever_arm")};
  c.time_offset = file["time_offset"].number();
  auto& deviation = imu.standard_deviation;
  deviation.gyro_bias = deviations<3>(file, "gyro_bias_standard_deviation");
  deviation.accel_bias = deviations<3>(file, "accel_bias_standard_deviation");
  deviation.gravity_direction = deviations<2>(file, "gravity_direction_standard_deviation");
  deviation.lever_arm = deviations<3>(file, "lever_arm_standard_deviation");
  deviation.time_offset = deviation_of(file["time_offset_standard_deviation"], "time_offset_standard_deviation");
  return imu;
}
