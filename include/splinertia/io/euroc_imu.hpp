// SPDX-License-Identifier: MIT
/// IMU samples in the ASL format of the EuRoC MAV dataset: lines `ns,wx,wy,wz,ax,ay,az`.
/// Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 2016.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <filesystem>
#include <ranges>
#include <splinertia/imu/imu_sample.hpp>
#include <splinertia/io/file_set.hpp>
#include <splinertia/io/stamped_table.hpp>
#include <splinertia/io/stamped_table_writer.hpp>
#include <splinertia/io/table_layout.hpp>
#include <string_view>
#include <vector>

namespace splinertia {

namespace detail {

inline constexpr std::array<std::string_view, 7> euroc_imu_columns{
    "timestamp [ns]",    "w_RS_S_x [rad s^-1]", "w_RS_S_y [rad s^-1]", "w_RS_S_z [rad s^-1]",
    "a_RS_S_x [m s^-2]", "a_RS_S_y [m s^-2]",   "a_RS_S_z [m s^-2]"};

inline const TableLayout euroc_imu_layout{.format = "EuRoC IMU samples",
                                          .columns = euroc_imu_columns,
                                          .fewest_columns = euroc_imu_columns.size(),
                                          .stamp = TableLayout::Stamp::nanoseconds,
                                          .separator = ',',
                                          .header = true};

}  // namespace detail

/// Reads the samples of a EuRoC IMU file; commas or blanks may separate its columns. Throws std::runtime_error with
/// file:line for the first error (StampedTable).
[[nodiscard]] inline std::vector<ImuSample<double, std::chrono::nanoseconds>> read_euroc_imu(
    const std::filesystem::path& path) {
  return read_stamped_table(path, detail::euroc_imu_layout, [](const StampedTable& row) {
    return ImuSample<double, std::chrono::nanoseconds>{row.time(), row.vector(1), row.vector(4)};
  });
}

/// Writes a EuRoC IMU file sample by sample, in constant memory. The file appears with commit() and reads back to the
/// same bits. Members throw std::runtime_error if the file cannot be written, and std::invalid_argument for what
/// read_euroc_imu would refuse: no samples, NaN, times that do not increase.
class EurocImuWriter {
 public:
  explicit EurocImuWriter(const std::filesystem::path& path) : table_(path, detail::euroc_imu_layout) {}

  /// One sample: an ImuSample or anything with its members, over any time; seconds are rounded to the nearest ns.
  void append(const ImuSampleLike auto& sample) { table_.append(sample.time, sample.gyro, sample.accel); }

  /// Writes a line that read_euroc_imu skips, `# ` and the text, before the next sample.
  void comment(std::string_view text) { table_.comment(text); }

  /// Completes the file. It appears now, or together with the others of a set.
  void commit(std::same_as<FileSet> auto&... set) { table_.commit(set...); }

 private:
  StampedTableWriter table_;
};

/// Writes all samples of a range, as EurocImuWriter does: of a vector, or as simulate() makes them.
template <std::ranges::input_range Samples>
  requires ImuSampleLike<std::ranges::range_value_t<Samples>>
void write_euroc_imu(const std::filesystem::path& path, Samples&& samples) {
  EurocImuWriter writer(path);
  for (const auto& sample : samples) writer.append(sample);
  writer.commit();
}

}  // namespace splinertia
