// SPDX-License-Identifier: MIT
#include "support/kalibr.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <splinertia/imu/g_sensitivity.hpp>
#include <splinertia/imu/misalignment_conventions.hpp>
#include <splinertia/imu/random_walk.hpp>
#include <splinertia/imu/white_noise.hpp>
#include <splinertia/message.hpp>

#include "support/yaml_reader.hpp"

using namespace splinertia;

namespace {

double positive(const YamlReader& file, const std::string& key) {
  const YamlReader entry = file[key];
  const double value = entry.number();
  if (!(value > 0)) entry.fail(message(key, " is ", value, ", expected a number > 0"));
  return value;
}

// The root of the sum of squares of the densities of all terms T, of the axis where it is largest.
template <typename T>
double density_of(const AnySensorModel& model) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const T& term : model.all<T>()) squares += term.density.vector().cwiseAbs2();
  return std::sqrt(squares.maxCoeff());
}

}  // namespace

KalibrImu read_kalibr(const std::filesystem::path& path) {
  const YamlReader whole = YamlReader::open(path);
  const YamlReader file = whole.has("imu0") ? whole["imu0"] : whole;
  KalibrImu imu;
  imu.gyro_noise_density = positive(file, "gyroscope_noise_density");
  imu.gyro_random_walk = positive(file, "gyroscope_random_walk");
  imu.accel_noise_density = positive(file, "accelerometer_noise_density");
  imu.accel_random_walk = positive(file, "accelerometer_random_walk");
  imu.update_rate = positive(file, "update_rate");
  if (file.has("rostopic")) imu.topic = file["rostopic"].text();

  const std::string model = file.has("model") ? file["model"].text() : "calibrated";
  if (model == "scale-misalignment") {
    const YamlReader gyro = file["gyroscopes"];
    const Eigen::Matrix3d rotation = gyro["C_gyro_i"].matrix();
    imu.gyro_misalignment = misalignment_from_kalibr<double>(gyro["M"].matrix(), rotation).matrix;
    imu.g_sensitivity = gyro["A"].matrix() * rotation;
    imu.accel_misalignment = file["accelerometers"]["M"].matrix();
  } else if (model != "calibrated") {
    file["model"].fail(message("model ", model, ", expected calibrated or scale-misalignment"));
  }
  return imu;
}

AnyImu errors_of(const KalibrImu& imu) {
  AnyImu errors;
  if (imu.gyro_misalignment) errors.gyro.add(Misalignment{*imu.gyro_misalignment});
  if (imu.g_sensitivity) errors.gyro.add(GSensitivity{*imu.g_sensitivity});
  errors.gyro.add(RandomWalk{imu.gyro_random_walk});
  errors.gyro.add(WhiteNoise{imu.gyro_noise_density});
  if (imu.accel_misalignment) errors.accel.add(Misalignment{*imu.accel_misalignment});
  errors.accel.add(RandomWalk{imu.accel_random_walk});
  errors.accel.add(WhiteNoise{imu.accel_noise_density});
  return errors;
}

std::optional<KalibrImu> kalibr_noise(const AnyImu& imu, double rate) {
  KalibrImu noise;
  noise.gyro_noise_density = density_of<WhiteNoise<double>>(imu.gyro);
  noise.gyro_random_walk = density_of<RandomWalk<double>>(imu.gyro);
  noise.accel_noise_density = density_of<WhiteNoise<double>>(imu.accel);
  noise.accel_random_walk = density_of<RandomWalk<double>>(imu.accel);
  noise.update_rate = rate;
  if (std::min({noise.gyro_noise_density, noise.gyro_random_walk, noise.accel_noise_density, noise.accel_random_walk}) >
      0) {
    return noise;
  }
  return std::nullopt;
}

std::string kalibr_text(const KalibrImu& imu) {
  YAML::Emitter out;
  const auto entry = [&](const char* key, const auto& value, const char* unit) {
    out << YAML::Key << key << YAML::Value << value;
    if (*unit != '\0') out << YAML::Comment(unit);
  };
  out << YAML::BeginMap;
  entry("rostopic", imu.topic, "");
  entry("update_rate", message(imu.update_rate), "Hz");
  entry("accelerometer_noise_density", message(imu.accel_noise_density), "m/s^2/sqrt(Hz), continuous");
  entry("accelerometer_random_walk", message(imu.accel_random_walk), "m/s^3/sqrt(Hz)");
  entry("gyroscope_noise_density", message(imu.gyro_noise_density), "rad/s/sqrt(Hz), continuous");
  entry("gyroscope_random_walk", message(imu.gyro_random_walk), "rad/s^2/sqrt(Hz)");
  out << YAML::EndMap;
  return std::string(out.c_str()) + '\n';
}
