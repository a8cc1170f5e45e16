// SPDX-License-Identifier: MIT
// The writing half of imu_noise.hpp. The units are those of each estimator's source code, the recommendations those of
// its documentation; docs/noise_densities.md and docs/allan.md have the tables.
#include <cmath>
#include <splinertia/errors/noise_densities.hpp>

#include "support/concat.hpp"
#include "support/imu_noise.hpp"
#include "support/yaml_text.hpp"

using splinertia::white_noise_sigma;

namespace {

using Lines = std::vector<std::string>;

std::string entry(std::string_view key, double value, std::string_view unit) {
  return concat(key, ": ", yaml_number(value), "  # ", unit);
}

std::string topic_entry(std::string_view key, const ImuNoise& noise) {
  return concat(key, ": ", yaml_string(noise.topic));
}

// OpenCV's FileStorage recognizes its files by the first line.
constexpr std::string_view file_storage_header = "%YAML:1.0\n---\n";

Lines kalibr_densities(const ImuNoise& noise) {
  return {entry("accelerometer_noise_density", noise.accel_noise_density, "m/s^2/sqrt(Hz)"),
          entry("accelerometer_random_walk", noise.accel_random_walk, "m/s^3/sqrt(Hz)"),
          entry("gyroscope_noise_density", noise.gyro_noise_density, "rad/s/sqrt(Hz)"),
          entry("gyroscope_random_walk", noise.gyro_random_walk, "rad/s^2/sqrt(Hz)")};
}

constexpr std::string_view densities_comment =
    "# The values are densities of continuous time: a sample has the standard deviation noise density*sqrt(rate),\n"
    "# and from one sample to the next the bias moves by random walk/sqrt(rate).\n";

std::string about(Estimator estimator) {
  switch (estimator) {
    case Estimator::kalibr:
      return concat(
          densities_comment,
          "# The values are not inflated. Kalibr's wiki (IMU Noise Model) says that the cheapest sensors may\n"
          "# need 10 times as much and more, because a sensor at rest shows neither errors of its scale factors\n"
          "# nor of temperature.\n");
    case Estimator::openvins:
      return concat(
          "# This is the kalibr_imu_chain.yaml of OpenVINS. The intrinsics are those of an ideal IMU.\n",
          densities_comment,
          "# The values are not inflated. OpenVINS' guide (Sensor Calibration, IMU Noise Calibration) suggests\n"
          "# 10 to 20 times as much, for errors that the model leaves out.\n");
    case Estimator::vins:
      return "# These lines belong in the configuration file of VINS-Mono or VINS-Fusion.\n"
             "# The values are of discrete time and hold for update_rate, which VINS does not read. acc_n and gyr_n "
             "are\n"
             "# standard deviations of a sample, noise density*sqrt(rate). acc_w and gyr_w are random "
             "walk*sqrt(rate),\n"
             "# because VINS takes acc_w*dt and gyr_w*dt for the standard deviation of a step of the bias.\n"
             "# The values are not inflated. VINS' documentation recommends no factor. Its file for EuRoC has about\n"
             "# 4 times the white noise of that data set.\n";
    case Estimator::orbslam3:
      return concat(
          "# These lines belong in the settings file of ORB-SLAM3.\n", densities_comment,
          "# The values are not inflated. ORB-SLAM3's Calibration_Tutorial.pdf (section 3.2) recommends about\n"
          "# 10 times GyroWalk and AccWalk, for errors that the model leaves out and for initialization.\n");
    case Estimator::gtsam:
      return "# These are members of GTSAM's PreintegrationCombinedParams, each to be multiplied by the 3x3 identity.\n"
             "# The values are squares of densities of continuous time. integrationCovariance and the uncertainty of\n"
             "# the initial bias do not follow from them and are not in this file.\n"
             "# The values are not inflated. GTSAM's documentation recommends no factor.\n";
  }
  return {};
}

Lines kalibr_entries(const ImuNoise& noise) {
  Lines lines{topic_entry("rostopic", noise), entry("update_rate", noise.update_rate, "Hz")};
  for (const std::string& line : kalibr_densities(noise)) lines.push_back(line);
  return lines;
}

Lines openvins_entries(const ImuNoise& noise) {
  const auto matrix = [](std::string_view key, int size, int diagonal) {
    std::string text = concat("  ", key, ":");
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) text += concat(j == 0 ? "\n    - [" : ", ", i == j ? diagonal : 0, ".0");
      text += ']';
    }
    return text;
  };
  Lines lines{"imu0:", matrix("T_i_b", 4, 1)};
  for (const std::string& line : kalibr_densities(noise)) lines.push_back("  " + line);
  lines.insert(lines.end(),
               {"  " + topic_entry("rostopic", noise), "  time_offset: 0.0",
                "  " + entry("update_rate", noise.update_rate, "Hz"), "  model: kalibr", matrix("Tw", 3, 1),
                matrix("R_IMUtoGYRO", 3, 1), matrix("Ta", 3, 1), matrix("R_IMUtoACC", 3, 1), matrix("Tg", 3, 0)});
  return lines;
}

Lines vins_entries(const ImuNoise& noise) {
  const auto per_sample = [&](double density) { return white_noise_sigma(density, noise.update_rate); };
  return {topic_entry("imu_topic", noise),
          entry("update_rate", noise.update_rate, "Hz"),
          entry("acc_n", per_sample(noise.accel_noise_density), "m/s^2"),
          entry("gyr_n", per_sample(noise.gyro_noise_density), "rad/s"),
          entry("acc_w", per_sample(noise.accel_random_walk), "m/s^3"),
          entry("gyr_w", per_sample(noise.gyro_random_walk), "rad/s^2")};
}

Lines orbslam3_entries(const ImuNoise& noise) {
  // ORB-SLAM3 before version 1.0 takes only whole numbers for the frequency.
  const bool whole = std::round(noise.update_rate) == noise.update_rate;
  return {
      entry("IMU.NoiseGyro", noise.gyro_noise_density, "rad/s/sqrt(Hz)"),
      entry("IMU.NoiseAcc", noise.accel_noise_density, "m/s^2/sqrt(Hz)"),
      entry("IMU.GyroWalk", noise.gyro_random_walk, "rad/s^2/sqrt(Hz)"),
      entry("IMU.AccWalk", noise.accel_random_walk, "m/s^3/sqrt(Hz)"),
      whole ? concat("IMU.Frequency: ", noise.update_rate, "  # Hz") : entry("IMU.Frequency", noise.update_rate, "Hz")};
}

Lines gtsam_entries(const ImuNoise& noise) {
  const auto squared = [](double density) { return density * density; };
  return {entry("update_rate", noise.update_rate, "Hz, not a member: GTSAM takes the time step with each sample"),
          entry("gyroscopeCovariance", squared(noise.gyro_noise_density), "(rad/s)^2/Hz"),
          entry("accelerometerCovariance", squared(noise.accel_noise_density), "(m/s^2)^2/Hz"),
          entry("biasOmegaCovariance", squared(noise.gyro_random_walk), "(rad/s^2)^2/Hz"),
          entry("biasAccCovariance", squared(noise.accel_random_walk), "(m/s^3)^2/Hz")};
}

Lines entries(Estimator estimator, const ImuNoise& noise) {
  switch (estimator) {
    case Estimator::kalibr:
      return kalibr_entries(noise);
    case Estimator::openvins:
      return openvins_entries(noise);
    case Estimator::vins:
      return vins_entries(noise);
    case Estimator::orbslam3:
      return orbslam3_entries(noise);
    case Estimator::gtsam:
      return gtsam_entries(noise);
  }
  return {};
}

}  // namespace

std::string imu_noise_text(Estimator estimator, const ImuNoise& noise, const std::vector<std::string>& comments) {
  const bool file_storage =
      estimator == Estimator::openvins || estimator == Estimator::vins || estimator == Estimator::orbslam3;
  std::string text(file_storage ? file_storage_header : "");
  for (const std::string& comment : comments) text += "# " + escaped_line(comment) + '\n';
  text += about(estimator);
  for (const std::string& line : entries(estimator, noise)) text += line + '\n';
  return text;
}
