// SPDX-License-Identifier: MIT
// Poses of a file, and the residuals of a curve.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <string>
#include <vector>

using Poses = std::vector<splinertia::Stamped<splinertia::SO3xR3<double>>>;

[[nodiscard]] std::chrono::nanoseconds longest_interval(const Poses& poses);

/// The median interval between neighbouring poses, s. Requires at least two poses.
[[nodiscard]] double median_interval(const Poses& poses);

/// Curve minus pose: the position in the world frame [m], the rotation in the body frame of the pose [rad].
struct PoseDistances {
  std::vector<Eigen::Vector3d> rotation{}, position{};
};

/// The residuals of a curve; `curve` has its values at the times of the poses.
[[nodiscard]] PoseDistances distances(const Poses& curve, const Poses& poses);

/// RMS and largest length of vectors.
struct Lengths {
  double rms = 0, max = 0;
};
/// Of all vectors except those with the indices `but`, which ascend.
[[nodiscard]] Lengths lengths(const std::vector<Eigen::Vector3d>& vectors, const std::vector<std::size_t>& but = {});

/// The outliers, in lines like "79.330 - 79.385 s (12 poses, up to 0.031 m, 0.002 rad)", in seconds from the first
/// pose. Runs with at most five poses between them are merged. If there are more than `most`, the worst are listed.
[[nodiscard]] std::vector<std::string> outlier_lines(const Poses& poses, const PoseDistances& distances,
                                                     const std::vector<std::size_t>& outliers, std::size_t most);
