// SPDX-License-Identifier: MIT
#include "support/imu_noise.hpp"

#include <algorithm>
#include <cmath>
#include <splinertia/errors/noise/correlated_noise.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/imu/errors/g_sensitivity.hpp>

using namespace splinertia;

namespace {

struct Names {
  std::string_view option, name, file;
};

const Names& names_of(Estimator estimator) {
  static constexpr std::array<Names, estimators.size()> table{{{"kalibr", "Kalibr", "imu.yaml"},
                                                               {"openvins", "OpenVINS", "openvins_imu.yaml"},
                                                               {"vins", "VINS", "vins_imu.yaml"},
                                                               {"orbslam3", "ORB-SLAM3", "orbslam3_imu.yaml"},
                                                               {"gtsam", "GTSAM", "gtsam_imu.yaml"}}};
  return table.at(static_cast<std::size_t>(estimator));
}

// The root of the sum of squares of the densities of all Terms, on the axis where it is largest.
template <typename... Terms>
double density_of(const AnySensorModel& model) {
  Eigen::Vector3d density = Eigen::Vector3d::Zero();
  const auto add = [&](const auto& terms) {
    for (const auto& term : terms) {
      const Eigen::Vector3d more = term.density.template vector<3>();
      for (int axis = 0; axis < 3; ++axis) density[axis] = std::hypot(density[axis], more[axis]);
    }
  };
  (add(model.all<Terms>()), ...);
  return density.maxCoeff();
}

double white_noise_of(const AnySensorModel& model) {
  return density_of<WhiteNoise<double, 1>, WhiteNoise<double, 3>, CorrelatedNoise<double, 3>>(model);
}
double random_walk_of(const AnySensorModel& model) {
  return density_of<RandomWalk<double, 1>, RandomWalk<double, 3>>(model);
}

}  // namespace

std::string_view option_name(Estimator estimator) { return names_of(estimator).option; }
std::string_view name(Estimator estimator) { return names_of(estimator).name; }
std::string_view file_name(Estimator estimator) { return names_of(estimator).file; }

AnyImu errors_of(const ImuNoise& noise) {
  AnyImu errors;
  if (noise.gyro_misalignment) errors.gyro.add(Misalignment{*noise.gyro_misalignment});
  if (noise.g_sensitivity) errors.gyro.add(GSensitivity{*noise.g_sensitivity});
  errors.gyro.add(RandomWalk{noise.gyro_random_walk});
  errors.gyro.add(WhiteNoise{noise.gyro_noise_density});
  if (noise.accel_misalignment) errors.accel.add(Misalignment{*noise.accel_misalignment});
  errors.accel.add(RandomWalk{noise.accel_random_walk});
  errors.accel.add(WhiteNoise{noise.accel_noise_density});
  return errors;
}

std::optional<ImuNoise> imu_noise_of(const AnyImu& imu, double rate) {
  ImuNoise noise;
  noise.gyro_noise_density = white_noise_of(imu.gyro);
  noise.gyro_random_walk = random_walk_of(imu.gyro);
  noise.accel_noise_density = white_noise_of(imu.accel);
  noise.accel_random_walk = random_walk_of(imu.accel);
  noise.update_rate = rate;
  if (std::min({noise.gyro_noise_density, noise.gyro_random_walk, noise.accel_noise_density, noise.accel_random_walk}) >
      0) {
    return noise;
  }
  return std::nullopt;
}
