// SPDX-License-Identifier: MIT
#include "dead_reckon/setup.hpp"

#include <splinertia/group/sophus.hpp>
#include <splinertia/units.hpp>

#include "support/calibration_file.hpp"
#include "support/formatted.hpp"

using namespace splinertia;

namespace {

const char* const trajectory_file = "the trajectory file";

std::string vector_text(const Eigen::Vector3d& v) { return formatted("(%.6g %.6g %.6g)", v.x(), v.y(), v.z()); }

}  // namespace

Setup setup(const Options& o, bool trajectory_has_biases) {
  Setup s;
  s.gravity = o.gravity.vector;
  s.gravity_source = o.gravity_given ? "--gravity" : "";
  if (trajectory_has_biases) s.gyro_bias_source = s.accel_bias_source = trajectory_file;
  if (!o.calibration.empty()) {
    const ImuCalibration<double> calibration = read_calibration(o.calibration).calibration;
    const std::string source = o.calibration.string();
    s.gyro_bias = calibration.gyro_bias;
    s.accel_bias = calibration.accel_bias;
    s.mounting = calibration.mounting;
    s.time_offset = calibration.time_offset;
    s.gyro_bias_source = s.accel_bias_source = s.arm_source = source;
    if (!o.gravity_given) {
      s.gravity = calibration.gravity;
      s.gravity_source = source;
    }
  }
  if (o.gyro_bias) {
    s.gyro_bias = o.gyro_bias;
    s.gyro_bias_source = "--gyro-bias";
  }
  if (o.accel_bias) {
    s.accel_bias = o.accel_bias;
    s.accel_bias_source = "--accel-bias";
  }
  if (o.lever_arm) {
    s.mounting.p_BI = *o.lever_arm;
    s.arm_source = "--lever-arm";
  }
  if (o.keep_biases) {
    s.gyro_bias = s.accel_bias = Eigen::Vector3d::Zero();
    s.gyro_bias_source = s.accel_bias_source = "";
  }
  return s;
}

std::string bias_text(const Setup& s) {
  if (s.gyro_bias_source == s.accel_bias_source) {
    if (s.gyro_bias_source.empty()) return "biases not removed";
    if (s.gyro_bias_source == trajectory_file) return "biases from the trajectory file removed";
  }
  const auto text = [](const char* name, const std::optional<Eigen::Vector3d>& bias, const std::string& source,
                       const char* unit) {
    if (source.empty()) return formatted("%s bias not removed", name);
    if (!bias) return formatted("%s bias from %s removed", name, source.c_str());
    return formatted("%s bias %s %s from %s removed", name, vector_text(*bias).c_str(), unit, source.c_str());
  };
  return text("gyro", s.gyro_bias, s.gyro_bias_source, "rad/s") + ", " +
         text("accel", s.accel_bias, s.accel_bias_source, "m/s^2");
}

std::string mounting_text(const Setup& s) {
  std::string text;
  if (!s.gravity_source.empty()) {
    text += formatted("gravity %s m/s^2 from %s\n", vector_text(s.gravity).c_str(), s.gravity_source.c_str());
  }
  if (!s.arm_source.empty()) {
    text += formatted(
        "lever arm %s m from %s; true states are moved to the IMU, velocities with the gyro's first reading\n",
        vector_text(s.mounting.p_BI).c_str(), s.arm_source.c_str());
  }
  const Eigen::Vector3d turn = GroupTraits<Sophus::SO3d>::log(s.mounting.R_BI) / units::degree;
  if (turn.norm() > 0) text += formatted("rotation vector of the IMU's axes %s deg\n", vector_text(turn).c_str());
  if (s.time_offset != 0) text += formatted("time offset %.9g s added to the IMU's times\n", s.time_offset);
  return text;
}
