// SPDX-License-Identifier: MIT
/// Trajectories in whichever of the known formats.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/io/euroc_groundtruth.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/seconds_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/io/tum.hpp>
#include <string_view>
#include <vector>

namespace splinertia {

enum class TrajectoryFormat { tum, euroc };

/// Tells TUM from EuRoC by what stands in the file, not by its name. Eight columns are TUM if the time has decimals and
/// EuRoC if it is whole and has commas behind it or could not be seconds (≥ 1e12); rows that leave both open are passed
/// over, because the formats differ in the order of the quaternion. Seventeen columns are EuRoC. Throws
/// std::runtime_error with file:line where a row is neither, or if no row tells.
[[nodiscard]] inline TrajectoryFormat recognize_trajectory(const std::filesystem::path& path) {
  constexpr std::string_view expected =
      ", expected TUM (t tx ty tz qx qy qz qw, blanks between, t in seconds with decimals) or EuRoC (8 or 17 columns "
      "ns,px,py,pz,qw,qx,qy,qz[,vx,vy,vz,bwx,bwy,bwz,bax,bay,baz], t in whole nanoseconds)";
  constexpr std::int64_t no_seconds = 1'000'000'000'000;
  TextFile file(path);
  std::vector<std::string_view> fields;
  bool rows = false;
  for (; file.next(); rows = true) {
    split_fields(file.line(), fields);
    const bool commas = file.line().find(',') != std::string_view::npos;
    const bool short_row = fields.size() == euroc_poses_layout.fewest_columns;
    const bool long_row = fields.size() == euroc_poses_layout.columns.size();
    const Parsed<std::int64_t> stamp = parse_integer(fields[0]);
    if (!stamp.problem && (long_row || (short_row && (commas || stamp.value >= no_seconds))))
      return TrajectoryFormat::euroc;
    if (stamp.problem && short_row && !commas && !parse_seconds(fields[0]).problem) return TrajectoryFormat::tum;
    if (stamp.problem || !short_row) file.fail(excerpt(file.line()), " is no row of a trajectory", expected);
  }
  file.fail(rows ? "whole stamps below 1e12 may be seconds or nanoseconds" : "no rows", expected);
}

/// The poses T_WB [m] of a TUM or EuRoC file. Throws std::runtime_error with file:line if it is neither
/// (recognize_trajectory), or for the first thing wrong in it (read_tum, read_euroc_poses).
[[nodiscard]] inline std::vector<Stamped<SO3xR3<double>>> read_trajectory(const std::filesystem::path& path) {
  return recognize_trajectory(path) == TrajectoryFormat::tum ? read_tum(path) : read_euroc_poses(path);
}

}  // namespace splinertia
