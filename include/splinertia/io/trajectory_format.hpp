// SPDX-License-Identifier: MIT
/// Describes how a trajectory file is read.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace splinertia {

/// The order of a quaternion's four numbers: real part first or last.
enum class QuaternionOrder { wxyz, xyzw };

/// The unit of the stamps: 10^-value s.
enum class TimeUnit { seconds = 0, milliseconds = 3, microseconds = 6, nanoseconds = 9 };

/// s, ms, us, ns
[[nodiscard]] constexpr std::string_view time_unit_name(TimeUnit unit) {
  constexpr std::array<std::string_view, 4> names{"s", "ms", "us", "ns"};
  return names[static_cast<std::size_t>(unit) / 3];
}

/// Describes a trajectory file. What is left out is inferred from the file: from the names of its columns if it has
/// any, otherwise from its shape. If that is ambiguous, read_trajectory refuses to guess.
struct TrajectoryFormat {
  enum class Kind { automatic, tum, euroc, kitti, vins, openvins, rpg, tartanair };

  Kind kind = Kind::automatic;

  /// What the columns hold, instead of a kind: a list such as "t,x,y,z,qx,qy,qz,qw". Names are t (time), x y z
  /// (position), qx qy qz qw or r11 r12 … r33 (attitude R_WB), vx vy vz (velocity in W), bgx bgy bgz and bax bay baz
  /// (biases), and - for a column to be ignored. A list that ends in ",..." accepts rows with more columns.
  std::string columns{};

  std::optional<QuaternionOrder> quaternion_order{};
  std::optional<TimeUnit> time_unit{};
  std::optional<double> rate{};   ///< Hz, of a file without stamps
  std::filesystem::path times{};  ///< file of the stamps, one per line, for a file without stamps (KITTI's times.txt)
  bool skip_bad_rows = false;     ///< leave bad rows out and count them; otherwise refuse the file
};

/// A format that has a name.
struct KnownTrajectoryFormat {
  TrajectoryFormat::Kind kind;
  std::string_view name;         // of the kind, as programs spell it
  std::string_view title;        // for messages
  std::string_view columns;      // of the longest rows
  std::size_t fewest_columns;    // rows may have only this many
  std::optional<TimeUnit> unit;  // none: no stamps
  std::string_view remark = "";  // on its frames, of interest when simulating an IMU along it
};

/// All formats that have a name. Sources: the sites of TUM RGB-D, EuRoC MAV, KITTI and TartanAir; the output of
/// VINS-Mono, VINS-Fusion, OpenVINS and rpg's simulators. OpenVINS writes the JPL quaternion of R_BW. Its numbers are
/// those of the Hamilton quaternion of R_WB, as which they are read.
inline constexpr std::array known_trajectory_formats{
    KnownTrajectoryFormat{TrajectoryFormat::Kind::tum, "tum", "a TUM trajectory", "t,x,y,z,qx,qy,qz,qw", 8,
                          TimeUnit::seconds},
    KnownTrajectoryFormat{TrajectoryFormat::Kind::euroc, "euroc", "EuRoC ground truth",
                          "t,x,y,z,qw,qx,qy,qz,vx,vy,vz,bgx,bgy,bgz,bax,bay,baz", 8, TimeUnit::nanoseconds},
    KnownTrajectoryFormat{TrajectoryFormat::Kind::kitti, "kitti", "KITTI poses",
                          "r11,r12,r13,x,r21,r22,r23,y,r31,r32,r33,z", 12, std::nullopt,
                          "KITTI's world is the first camera: y points down, so gravity is 0 9.81 0 there (--gravity)"},
    KnownTrajectoryFormat{TrajectoryFormat::Kind::vins, "vins", "VINS odometry", "t,x,y,z,qw,qx,qy,qz,vx,vy,vz", 8,
                          TimeUnit::nanoseconds},
    KnownTrajectoryFormat{TrajectoryFormat::Kind::openvins, "openvins", "OpenVINS states",
                          "t,qx,qy,qz,qw,x,y,z,vx,vy,vz,bgx,bgy,bgz,bax,bay,baz,...", 17, TimeUnit::seconds},
    KnownTrajectoryFormat{TrajectoryFormat::Kind::rpg, "rpg", "an rpg trajectory", "t,x,y,z,qx,qy,qz,qw", 8,
                          TimeUnit::nanoseconds},
    KnownTrajectoryFormat{TrajectoryFormat::Kind::tartanair, "tartanair", "TartanAir poses", "x,y,z,qx,qy,qz,qw", 7,
                          std::nullopt,
                          "TartanAir's world is NED: z points down, so gravity is 0 0 9.81 there (--gravity)"}};

}  // namespace splinertia
