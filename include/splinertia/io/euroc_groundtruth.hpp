// SPDX-License-Identifier: MIT
/// Ground truth in the ASL format of the EuRoC MAV dataset: lines `ns,px,py,pz,qw,qx,qy,qz`, with or without velocity
/// and biases behind them. Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 2016.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
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

/// One row of 17 columns: the pose T_WB [m], velocity in W [m/s], biases in B [rad/s], [m/s²]. (EuRoC's R is W, its S
/// is B.) A range of them is also one of poses, for fit(), associate(), write_tum() and others.
struct EurocState : Stamped<SO3xR3<double>> {
  Eigen::Vector3d velocity, gyro_bias, accel_bias;
};

namespace detail {

inline constexpr std::array<std::string_view, 17> euroc_groundtruth_columns{"timestamp [ns]",
                                                                            "p_RS_R_x [m]",
                                                                            "p_RS_R_y [m]",
                                                                            "p_RS_R_z [m]",
                                                                            "q_RS_w []",
                                                                            "q_RS_x []",
                                                                            "q_RS_y []",
                                                                            "q_RS_z []",
                                                                            "v_RS_R_x [m s^-1]",
                                                                            "v_RS_R_y [m s^-1]",
                                                                            "v_RS_R_z [m s^-1]",
                                                                            "b_w_RS_S_x [rad s^-1]",
                                                                            "b_w_RS_S_y [rad s^-1]",
                                                                            "b_w_RS_S_z [rad s^-1]",
                                                                            "b_a_RS_S_x [m s^-2]",
                                                                            "b_a_RS_S_y [m s^-2]",
                                                                            "b_a_RS_S_z [m s^-2]"};

inline const TableLayout euroc_groundtruth_layout{.format = "EuRoC ground truth",
                                                  .columns = euroc_groundtruth_columns,
                                                  .fewest_columns = euroc_groundtruth_columns.size(),
                                                  .stamp = TableLayout::Stamp::nanoseconds,
                                                  .separator = ',',
                                                  .header = true};

/// The same; velocity and biases may be missing.
inline const TableLayout euroc_poses_layout = [] {
  TableLayout layout = euroc_groundtruth_layout;
  layout.fewest_columns = 8;
  return layout;
}();

/// The pose in a row of EuRoC ground truth.
[[nodiscard]] inline SO3xR3<double> euroc_pose(const StampedTable& row, QuaternionTrack& track) {
  return {track.next(row, {row[4], row[5], row[6], row[7]}), row.vector(1)};
}

}  // namespace detail

/// Reads the states of a EuRoC ground truth file of 17 columns, separated by commas or blanks. Quaternions are
/// normalised and get continuous signs (QuaternionTrack). Throws std::runtime_error with file:line for the first error
/// (StampedTable).
[[nodiscard]] inline std::vector<EurocState> read_euroc_groundtruth(const std::filesystem::path& path) {
  return read_stamped_table(
      path, detail::euroc_groundtruth_layout, [track = detail::QuaternionTrack{}](const StampedTable& row) mutable {
        return EurocState{{row.time(), detail::euroc_pose(row, track)}, row.vector(8), row.vector(11), row.vector(14)};
      });
}

/// Reads the poses T_WB [m] of a EuRoC ground truth file of 8 or 17 columns, otherwise as read_euroc_groundtruth.
[[nodiscard]] inline std::vector<Stamped<SO3xR3<double>>> read_euroc_poses(const std::filesystem::path& path) {
  return read_stamped_table(path, detail::euroc_poses_layout,
                            [track = detail::QuaternionTrack{}](const StampedTable& row) mutable {
                              return Stamped<SO3xR3<double>>{row.time(), detail::euroc_pose(row, track)};
                            });
}

/// Writes EuRoC ground truth of 17 columns state by state, in constant memory. The file appears with commit() and reads
/// back to the same bits. Members throw std::runtime_error if the file cannot be written, and std::invalid_argument for
/// what read_euroc_groundtruth would refuse: no states, NaN, times that do not increase.
class EurocGroundtruthWriter {
 public:
  explicit EurocGroundtruthWriter(const std::filesystem::path& path) : table_(path, detail::euroc_groundtruth_layout) {}

  /// One state: an EurocState or any type with its members, over any time, with any pose of doubles.
  template <detail::StampedValue State>
    requires Pose<detail::GroupOf<State>>
  void append(const State& state) {
    const Eigen::Quaterniond& q = rotation(state.value).unit_quaternion();
    table_.append(state.time, position(state.value), Eigen::Vector4d{q.w(), q.x(), q.y(), q.z()}, state.velocity,
                  state.gyro_bias, state.accel_bias);
  }

  /// Completes the file. It appears now, or together with the others of a set.
  void commit(std::same_as<FileSet> auto&... set) { table_.commit(set...); }

 private:
  StampedTableWriter table_;
};

/// Writes all states of a range, as EurocGroundtruthWriter does.
template <std::ranges::input_range States>
void write_euroc_groundtruth(const std::filesystem::path& path, States&& states) {
  EurocGroundtruthWriter writer(path);
  for (const auto& state : states) writer.append(state);
  writer.commit();
}

}  // namespace splinertia
