// SPDX-License-Identifier: MIT
/// Trajectories in the format of the TUM RGB-D benchmark: lines `t tx ty tz qx qy qz qw`, time in seconds.
/// https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats
#pragma once

#include <array>
#include <concepts>
#include <filesystem>
#include <ranges>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/io/detail/quaternion_track.hpp>
#include <splinertia/io/file_set.hpp>
#include <splinertia/io/stamped_table.hpp>
#include <splinertia/io/stamped_table_writer.hpp>
#include <splinertia/io/table_layout.hpp>
#include <string_view>
#include <vector>

namespace splinertia {

namespace detail {

inline constexpr std::array<std::string_view, 8> tum_columns{"t", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};

/// Blanks between the columns, as the format requires; no header, because not every reader skips it.
inline const TableLayout tum_layout{.format = "a TUM trajectory",
                                    .columns = tum_columns,
                                    .fewest_columns = tum_columns.size(),
                                    .stamp = TableLayout::Stamp::seconds,
                                    .separator = ' ',
                                    .header = false};

}  // namespace detail

/// Reads the poses T_WB [m] of a TUM file. Times are rounded to the nearest nanosecond. Quaternions are normalised and
/// get continuous signs (QuaternionTrack). Throws std::runtime_error with file:line for the first error (StampedTable).
[[nodiscard]] inline std::vector<Stamped<SO3xR3<double>>> read_tum(const std::filesystem::path& path) {
  return read_stamped_table(path, detail::tum_layout,
                            [track = detail::QuaternionTrack{}](const StampedTable& row) mutable {
                              const Sophus::SO3d R_WB = track.next(row, {row[7], row[4], row[5], row[6]});
                              return Stamped<SO3xR3<double>>{row.time(), {R_WB, row.vector(1)}};
                            });
}

/// Writes a TUM file pose by pose, in constant memory. The file appears with commit() and reads back to the same bits.
/// Times have nine decimals; those in nanoseconds are exact. Members throw std::runtime_error if the file cannot be
/// written, and std::invalid_argument for what read_tum would refuse: no poses, NaN, times that do not increase.
class TumWriter {
 public:
  explicit TumWriter(const std::filesystem::path& path) : table_(path, detail::tum_layout) {}

  /// A pose T_WB of doubles, over any time.
  template <detail::StampedValue T>
    requires Pose<detail::GroupOf<T>> && std::same_as<ScalarOf<detail::GroupOf<T>>, double>
  void append(const T& stamped) {
    table_.append(stamped.time, position(stamped.value), rotation(stamped.value).unit_quaternion().coeffs());
  }

  /// Completes the file. It appears now, or together with the others of a set.
  void commit(std::same_as<FileSet> auto&... set) { table_.commit(set...); }

 private:
  StampedTableWriter table_;
};

/// Writes all poses T_WB [m] of a range, as TumWriter does.
template <std::ranges::input_range Poses>
  requires detail::StampedValue<std::ranges::range_value_t<Poses>>
void write_tum(const std::filesystem::path& path, Poses&& poses) {
  TumWriter writer(path);
  for (const auto& stamped : poses) writer.append(stamped);
  writer.commit();
}

}  // namespace splinertia
