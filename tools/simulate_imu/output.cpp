// SPDX-License-Identifier: MIT
#include "output.hpp"

#include <splinertia/group/pose.hpp>

#include "support/imu_noise.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

OutputFolder output_folder(const Options& o, const Sensor& sensor) {
  Inputs inputs = inputs_of(o.input);
  inputs.insert(inputs.end(), {o.errors, o.imu_noise});
  OutputFolder folder(o.output, "simulate_imu", inputs);
  folder.expect_no_inputs({"imu.csv", "groundtruth.csv", "poses.tum"});
  if (o.npy) folder.expect_no_inputs({"imu.npy"});
  if (imu_noise_of(sensor.errors, sensor.rate)) folder.expect_no_inputs({"imu.yaml"});
  folder.files().expect_not_kept(o.csv, "another path for --csv");
  return folder;
}

Output::Output(const Options& o, const Sensor& sensor, const std::vector<Hole>& holes, OutputFolder& folder)
    : folder_(folder),
      imu_csv_(folder_.path("imu.csv")),
      imu_npy_(o.npy ? std::make_optional<NpyImuWriter>(folder_.path("imu.npy")) : std::nullopt),
      groundtruth_csv_(folder_.path("groundtruth.csv")),
      poses_tum_(folder_.path("poses.tum")) {
  if (const auto noise = imu_noise_of(sensor.errors, sensor.rate)) {
    imu_yaml_.emplace(folder_.path("imu.yaml")).append(imu_noise_text(Estimator::kalibr, *noise));
  }
  if (!o.csv.empty()) table_csv_.emplace(o.csv);
  if (!holes.empty()) write_holes(gaps_csv_.emplace(folder_.path("gaps.csv")), holes);
}

void Output::append(const StampedImuReading<double, nanoseconds>& reading, const TrueState& truth) {
  const SO3xR3<double> pose{truth.R_WB, truth.p_WB};
  imu_csv_.append(reading);
  if (imu_npy_) imu_npy_->append(reading);
  groundtruth_csv_.append(EurocState{{truth.time, pose}, truth.v_WB, reading.gyro_bias, reading.accel_bias});
  poses_tum_.append(Stamped<SO3xR3<double>>{truth.time, pose});
}

std::string Output::commit() {
  FileSet& files = folder_.files();
  for (auto* file : {&table_csv_, &gaps_csv_, &imu_yaml_}) {
    if (*file) (*file)->commit(files);
  }
  poses_tum_.commit(files);
  groundtruth_csv_.commit(files);
  if (imu_npy_) imu_npy_->commit(files);
  imu_csv_.commit(files);  // appears last
  return folder_.commit();
}
