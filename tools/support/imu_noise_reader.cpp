// SPDX-License-Identifier: MIT
// The reading half of imu_noise.hpp.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <splinertia/errors/noise_densities.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/errors/scale/misalignment_conventions.hpp>
#include <stdexcept>

#include "support/concat.hpp"
#include "support/imu_noise.hpp"
#include "support/yaml_reader.hpp"

namespace {

/// The keys of a format: white noise and walk of the gyroscope, then of the accelerometer.
struct Format {
  Estimator estimator;
  const char* owners;
  std::array<const char*, 4> keys;
};
constexpr std::array<Format, 4> formats{
    {{Estimator::kalibr,
      "Kalibr or OpenVINS",
      {"gyroscope_noise_density", "gyroscope_random_walk", "accelerometer_noise_density", "accelerometer_random_walk"}},
     {Estimator::vins, "VINS", {"gyr_n", "gyr_w", "acc_n", "acc_w"}},
     {Estimator::orbslam3, "ORB-SLAM3", {"IMU.NoiseGyro", "IMU.GyroWalk", "IMU.NoiseAcc", "IMU.AccWalk"}},
     {Estimator::gtsam,
      "GTSAM",
      {"gyroscopeCovariance", "biasOmegaCovariance", "accelerometerCovariance", "biasAccCovariance"}}}};

const Format& format_of(const YamlReader& file) {
  std::vector<const Format*> found;
  for (const Format& format : formats) {
    const auto in_file = [&](const char* key) { return file.has(key); };
    if (std::any_of(format.keys.begin(), format.keys.end(), in_file)) found.push_back(&format);
  }
  if (found.empty()) {
    std::string expected;
    for (const Format& format : formats) {
      expected += concat(expected.empty() ? "" : ", ", format.owners, " (", format.keys[0], ", ...)");
    }
    file.fail("no IMU noise, expected the keys of " + expected);
  }
  if (found.size() > 1) {
    file.fail(concat("keys of ", found[0]->owners, " (", found[0]->keys[0], ", ...) and of ", found[1]->owners, " (",
                     found[1]->keys[0], ", ...), expected only those of one"));
  }
  return *found.front();
}

double positive(const YamlReader& file, const char* key) {
  const YamlReader entry = file[key];
  const double value = entry.number();
  if (!(value > 0)) entry.fail(concat(key, " is ", value, ", expected a number > 0"));
  return value;
}

double update_rate(const YamlReader& file, Estimator estimator, std::optional<double> rate) {
  const char* key = estimator == Estimator::orbslam3 ? "IMU.Frequency" : "update_rate";
  const bool optional = estimator == Estimator::vins || estimator == Estimator::gtsam;
  if (file.has(key) || !optional) return positive(file, key);
  if (rate) return *rate;
  if (estimator == Estimator::vins) {
    file.fail("no update_rate, expected one or --rate: VINS' values are per sample and depend on the rate");
  }
  return ImuNoise{}.update_rate;
}

/// Calls work(). If it rejects a value, the message names the place in the file.
void use(const YamlReader& place, const auto& work) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    place.fail(error.what());
  }
}

void read_kalibr_intrinsics(const YamlReader& file, ImuNoise& noise) {
  const YamlReader gyro = file["gyroscopes"], accel = file["accelerometers"];
  const Eigen::Matrix3d rotation = gyro["C_gyro_i"].matrix();
  use(gyro["M"], [&] {
    noise.gyro_misalignment = splinertia::misalignment_from_kalibr<double>(gyro["M"].matrix(), rotation).matrix;
  });
  noise.g_sensitivity = gyro["A"].matrix() * rotation;
  use(accel["M"], [&] { noise.accel_misalignment = splinertia::Misalignment<double>(accel["M"].matrix()).matrix; });
}

/// OpenVINS: the gyroscope reads Tw·R_IMUtoGYRO·ω + Tg·a, the accelerometer Ta·R_IMUtoACC·a.
/// https://docs.openvins.com/propagation.html
void read_openvins_intrinsics(const YamlReader& file, ImuNoise& noise) {
  const auto matrix = [&](const char* key, const Eigen::Matrix3d& otherwise) -> Eigen::Matrix3d {
    return file.has(key) ? file[key].matrix() : otherwise;
  };
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity(), zero = Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d gyro = matrix("Tw", identity) * matrix("R_IMUtoGYRO", identity);
  const Eigen::Matrix3d accel = matrix("Ta", identity) * matrix("R_IMUtoACC", identity);
  const Eigen::Matrix3d sensitivity = matrix("Tg", zero);
  if (gyro != identity) noise.gyro_misalignment = gyro;
  if (accel != identity) noise.accel_misalignment = accel;
  if (sensitivity != zero) noise.g_sensitivity = sensitivity;
}

void read_intrinsics(const YamlReader& file, ImuNoise& noise) {
  const std::string model = file.has("model") ? file["model"].text() : "calibrated";
  if (model == "scale-misalignment") {
    read_kalibr_intrinsics(file, noise);
  } else if (model == "calibrated" || model == "kalibr" || model == "rpng") {
    read_openvins_intrinsics(file, noise);  // Kalibr's model `calibrated` has no intrinsics
  } else {
    file["model"].fail(
        concat("model ", model, ", expected calibrated or scale-misalignment (Kalibr), kalibr or rpng (OpenVINS)"));
  }
}

/// Converts a value of a file to a density.
double density_of(Estimator estimator, double value, double rate) {
  switch (estimator) {
    case Estimator::vins:
      return splinertia::white_noise_density(value, rate);  // acc_w, gyr_w have the same factor, √rate
    case Estimator::gtsam:
      return std::sqrt(value);
    default:
      return value;
  }
}

}  // namespace

ImuNoise read_imu_noise(const std::filesystem::path& path, std::optional<double> rate) {
  const YamlReader whole = YamlReader::open(path);
  const YamlReader file = whole.has("imu0") ? whole["imu0"] : whole;
  const Format& format = format_of(file);
  ImuNoise noise;
  const std::array<double*, 4> densities{&noise.gyro_noise_density, &noise.gyro_random_walk, &noise.accel_noise_density,
                                         &noise.accel_random_walk};
  for (std::size_t i = 0; i < densities.size(); ++i) *densities[i] = positive(file, format.keys[i]);
  noise.update_rate = update_rate(file, format.estimator, rate);
  for (std::size_t i = 0; i < densities.size(); ++i) {
    double& density = *densities[i];
    density = density_of(format.estimator, density, noise.update_rate);
    if (!(density > 0) || !std::isfinite(density)) {
      file[format.keys[i]].fail(concat(format.keys[i], " is a density of ", density, ", expected a number > 0"));
    }
  }
  const char* topic = format.estimator == Estimator::vins ? "imu_topic" : "rostopic";
  if (file.has(topic)) noise.topic = file[topic].text();
  if (format.estimator == Estimator::kalibr) read_intrinsics(file, noise);
  use(file, [&] { (void)errors_of(noise); });
  return noise;
}
