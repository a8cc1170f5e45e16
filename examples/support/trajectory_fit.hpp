// SPDX-License-Identifier: MIT
// Splines through the poses of a file, and in words what was found on the way: distances, outliers, gaps.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/stamped.hpp>
#include <splinertia/message.hpp>
#include <splinertia/spline/fit.hpp>
#include <splinertia/spline/spline.hpp>
#include <splinertia/spline/uniform_knots.hpp>
#include <stdexcept>
#include <string>
#include <vector>

using Poses = std::vector<splinertia::Stamped<splinertia::SO3xR3<double>>>;
using Gap = splinertia::FitGap<std::chrono::nanoseconds>;

template <splinertia::Pose G, int Order>
using UniformCurve = splinertia::Spline<G, Order, splinertia::UniformKnots<std::chrono::nanoseconds>>;

// fit() takes long to compile: once, in trajectory_fit.cpp, for all programs.
#define SPLINERTIA_EXAMPLES_FIT(prefix, group, order)                                 \
  prefix template splinertia::Fit<UniformCurve<group, order>> splinertia::fit(        \
      const std::vector<splinertia::Stamped<group, std::chrono::nanoseconds>>& poses, \
      const splinertia::FitOptions<UniformCurve<group, order>>& options)
SPLINERTIA_EXAMPLES_FIT(extern, splinertia::SO3xR3<double>, 3);
SPLINERTIA_EXAMPLES_FIT(extern, splinertia::SO3xR3<double>, 4);
SPLINERTIA_EXAMPLES_FIT(extern, splinertia::SO3xR3<double>, 5);
SPLINERTIA_EXAMPLES_FIT(extern, splinertia::SO3xR3<double>, 6);
SPLINERTIA_EXAMPLES_FIT(extern, Sophus::SE3d, 3);
SPLINERTIA_EXAMPLES_FIT(extern, Sophus::SE3d, 4);
SPLINERTIA_EXAMPLES_FIT(extern, Sophus::SE3d, 5);
SPLINERTIA_EXAMPLES_FIT(extern, Sophus::SE3d, 6);

/// Calls work(), and says which file it is about where the library refuses its values.
auto about(const std::filesystem::path& file, const auto& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(splinertia::message(file.string(), ": ", error.what()));
  }
}

/// s: 0.05, or where the poses are sparse two of their intervals, so that they hold the knots.
[[nodiscard]] double default_knot_interval(const Poses& poses);

[[nodiscard]] std::chrono::nanoseconds longest_interval(const Poses& poses);

/// How far a curve is from each pose: in position in the world [m], in rotation in the body of the pose [rad].
struct PoseDistances {
  std::vector<Eigen::Vector3d> rotation{}, position{};
};

template <typename Curve>
[[nodiscard]] PoseDistances distances(const Curve& curve, const Poses& poses) {
  PoseDistances result;
  for (const auto& [time, pose] : poses) {
    const auto value = curve.template evaluate<0>(time).value;
    result.rotation.push_back(splinertia::increment(splinertia::rotation(pose), splinertia::rotation(value)));
    result.position.push_back(splinertia::position(value) - splinertia::position(pose));
  }
  return result;
}

/// RMS and largest length of vectors.
struct Lengths {
  double rms = 0, max = 0;
};
/// Of all but some, whose indices ascend.
[[nodiscard]] Lengths lengths(const std::vector<Eigen::Vector3d>& vectors, const std::vector<std::size_t>& but = {});

/// The outliers, in lines like "79.330 - 79.385 s (12 poses, up to 0.031 m, 0.002 rad)", in seconds from the first
/// pose. Runs with at most five poses between are one. Of more than `most` the worst are named.
[[nodiscard]] std::vector<std::string> outlier_lines(const Poses& poses, const PoseDistances& distances,
                                                     const std::vector<std::size_t>& outliers, std::size_t most);

/// The gaps, a line each, and of the first `most` when they are and which control points the poses leave free.
[[nodiscard]] std::vector<std::string> gap_lines(const Poses& poses, const std::vector<Gap>& gaps, std::size_t most);
