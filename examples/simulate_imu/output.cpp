// SPDX-License-Identifier: MIT
#include "output.hpp"

#include <filesystem>
#include <splinertia/group/pose.hpp>
#include <splinertia/message.hpp>
#include <stdexcept>
#include <system_error>

#include "support/formatted.hpp"
#include "support/imu_noise.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

std::filesystem::path created(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(message(folder.string(), ": cannot create this folder: ", error.message()));
  return folder;
}

}  // namespace

Output::Output(const Options& o, const Sensor& sensor, const std::vector<Hole>& holes)
    : folder_(created(o.output)),
      imu_csv_(folder_ / "imu.csv"),
      groundtruth_csv_(folder_ / "groundtruth.csv"),
      poses_tum_(folder_ / "poses.tum") {
  if (o.npy) imu_npy_.emplace(folder_ / "imu.npy");
  if (const auto noise = imu_noise_of(sensor.errors, sensor.rate)) {
    imu_yaml_.emplace(folder_ / "imu.yaml").append(imu_noise_text(Estimator::kalibr, *noise));
  }
  if (!holes.empty()) gaps_csv_.emplace(folder_ / "gaps.csv").append(holes_csv(holes));
}

void Output::append(const StampedImuReading<double, nanoseconds>& reading, const TrueState& truth) {
  const SO3xR3<double> pose{truth.R_WB, truth.p_WB};
  const EurocImu imu{reading.time, reading.gyro, reading.accel};
  imu_csv_.append(imu);
  if (imu_npy_) imu_npy_->append(imu);
  groundtruth_csv_.append(EurocState{truth.time, pose, truth.v_WB, reading.gyro_bias, reading.accel_bias});
  poses_tum_.append(Stamped<SO3xR3<double>>{truth.time, pose});
}

std::string Output::commit() {
  imu_csv_.commit();
  if (imu_npy_) imu_npy_->commit();
  groundtruth_csv_.commit();
  poses_tum_.commit();
  if (imu_yaml_) imu_yaml_->commit();
  if (gaps_csv_) gaps_csv_->commit();
  // That of another run would be taken for this one's.
  std::error_code error;
  if (!gaps_csv_) std::filesystem::remove(folder_ / "gaps.csv", error);
  std::vector<std::string> names{"imu.csv", "groundtruth.csv", "poses.tum"};
  if (imu_npy_) names.insert(names.begin() + 1, "imu.npy");
  if (imu_yaml_) names.emplace_back("imu.yaml");
  if (gaps_csv_) names.emplace_back("gaps.csv");
  return list_of(names);
}
