// SPDX-License-Identifier: MIT
#include <deque>
#include <splinertia/imu/simulate.hpp>
#include <splinertia/io/atomic_file.hpp>
#include <splinertia/io/euroc_imu.hpp>
#include <splinertia/io/tum.hpp>

#include "files.hpp"
#include "support/calibration_file.hpp"
#include "support/concat.hpp"
#include "support/csv_table.hpp"
#include "support/formatted.hpp"
#include "support/progress.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// After the comments the file is EuRoC ground truth with 8 columns.
void write_control_points(AtomicFile& file, const FittedTrajectory& fitted, const Options& o) {
  file.append(concat("# cumulative B-spline: p and q of control points T_WB, at the times that they belong to\n",
                     "# group: ", o.fit.group == "split" ? "SO3xR3" : "SE3", "\n# order: ", o.fit.order, '\n'));
  if (fitted.interval) {
    file.append(concat("# knots: uniform\n# start [ns]: ", fitted.curve.start().count(),
                       "\n# interval [ns]: ", fitted.interval->count(),
                       "\n# segment s = 0, 1, ... begins at start + s*interval and uses control points s to s + ",
                       o.fit.order - 1, '\n'));
  } else {
    file.append(concat("# knots: non-uniform, see knots.csv\n# start [ns]: ", fitted.curve.start().count(),
                       "\n# from knot i to knot i + 1 it uses control points i - ", o.fit.order - 1, " to i\n"));
  }
  file.append(concat("# end [ns]: ", fitted.curve.end().count(), '\n'));
  CsvTable table(file, {"#timestamp [ns]", "p_x [m]", "p_y [m]", "p_z [m]", "q_w []", "q_x []", "q_y []", "q_z []"});
  for (const auto& [time, pose] : fitted.control_points) {
    const Eigen::Quaterniond& q = rotation(pose).unit_quaternion();
    table.row(time, position(pose), q.w(), q.x(), q.y(), q.z());
  }
}

void write_residuals(AtomicFile& file, const FittedTrajectory& fitted) {
  CsvTable table(file, {"#timestamp [ns]", "rotation_x [rad]", "rotation_y [rad]", "rotation_z [rad]", "position_x [m]",
                        "position_y [m]", "position_z [m]", "outlier"});
  auto outlier = fitted.outliers.begin();
  for (std::size_t i = 0; i < fitted.smoothed.size(); ++i) {
    const bool is_outlier = outlier != fitted.outliers.end() && *outlier == i;
    if (is_outlier) ++outlier;
    table.row(fitted.smoothed[i].time, fitted.distances.rotation[i], fitted.distances.position[i], is_outlier);
  }
}

void write_knots(AtomicFile& file, const FittedTrajectory& fitted) {
  CsvTable table(file, {"#knot [ns]"});
  for (const nanoseconds knot : fitted.knots) table.row(knot);
}

void write_samples(AtomicFile& file, const FittedImu& imu) {
  CsvTable table(file, {"#timestamp [ns]", "gyro_x [rad/s]", "gyro_y [rad/s]", "gyro_z [rad/s]", "accel_x [m/s^2]",
                        "accel_y [m/s^2]", "accel_z [m/s^2]", "gyro_residual_x [rad/s]", "gyro_residual_y [rad/s]",
                        "gyro_residual_z [rad/s]", "accel_residual_x [m/s^2]", "accel_residual_y [m/s^2]",
                        "accel_residual_z [m/s^2]", "invented"});
  for (const SampleResidual& sample : imu.samples) {
    table.row(sample.time, sample.gyro, sample.accel, sample.gyro_residual, sample.accel_residual, sample.invented);
  }
}

/// Writes the readings along the curve. Those in holes are left out, or kept after a comment. Returns a note on them.
std::string write_readings(EurocImuWriter& file, const FittedTrajectory& fitted, const Options& o) {
  const auto readings = simulate(fitted.curve, Imu{}, {.rate = o.rate, .gravity = o.gravity.vector});
  Progress progress(readings.size());
  std::size_t invented = 0;
  std::optional<std::size_t> last_hole;
  for (const auto& reading : readings) {
    progress.advance();
    const auto hole = hole_at(fitted.holes, reading.time);
    if (hole) ++invented;
    if (hole && !o.keep_holes) continue;
    if (hole && hole != last_hole) file.comment(hole_comment(fitted.holes[*hole]));
    last_hole = hole;
    file.append(reading);
  }
  if (fitted.holes.empty()) return "";
  return formatted("%zu of %zu readings are inside holes and %s\n", invented, readings.size(),
                   o.keep_holes ? "invented; comments in derived_imu.csv mark them"
                                : "left out of derived_imu.csv; --keep-holes keeps them");
}

}  // namespace

WrittenFiles write_files(const FittedTrajectory& fitted, const std::string& report, const Options& o,
                         OutputFolder& folder) {
  std::deque<AtomicFile> files;
  const auto begin = [&](const char* name) -> AtomicFile& { return files.emplace_back(folder.path(name)); };
  write_control_points(begin("control_points.csv"), fitted, o);
  if (!fitted.knots.empty()) write_knots(begin("knots.csv"), fitted);
  write_residuals(begin("residuals.csv"), fitted);
  write_holes(begin("gaps.csv"), fitted.holes);
  if (fitted.imu) write_samples(begin("imu_residuals.csv"), *fitted.imu);
  if (fitted.imu) begin("calibration.yaml").append(calibration_text(fitted.imu->calibrated));
  begin("report.txt").append(report);
  EurocImuWriter derived(folder.path("derived_imu.csv"));
  TumWriter smoothed(folder.path("smoothed.tum"));
  WrittenFiles written;
  written.note = write_readings(derived, fitted, o);
  for (const auto& pose : fitted.smoothed) smoothed.append(pose);
  smoothed.commit(folder.files());
  derived.commit(folder.files());
  // control_points.csv appears last.
  for (auto file = files.rbegin(); file != files.rend(); ++file) file->commit(folder.files());
  written.names = folder.commit();
  return written;
}
