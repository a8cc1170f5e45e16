// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <splinertia/detail/message.hpp>
#include <splinertia/group/sophus.hpp>
#include <splinertia/io/stamped_table.hpp>
#include <string>

namespace splinertia::detail {

/// Converts the quaternions in successive rows of a table to rotations. Each is normalised and gets the sign nearer to
/// its predecessor (the first keeps its own), so that the four numbers are continuous where the motion is.
///
/// A norm that is 1 within `exact_norm` differs from 1 by rounding only. Such a quaternion is not normalised, so that
/// what the writers wrote reads back to the same bits.
class QuaternionTrack {
 public:
  static constexpr double norm_tolerance = 1e-3;
  static constexpr double exact_norm = 1e-12;

  /// Whether the norm is 1 within `norm_tolerance`.
  [[nodiscard]] static bool is_unit(const Eigen::Quaterniond& q) { return std::abs(q.norm() - 1) <= norm_tolerance; }

  /// The rotation of the next quaternion. Requires is_unit(q).
  [[nodiscard]] Sophus::SO3d next(const Eigen::Quaterniond& q) {
    const double norm = q.norm();
    Eigen::Vector4d coefficients = q.coeffs();
    if (std::abs(norm - 1) > exact_norm) coefficients /= norm;
    if (coefficients.dot(previous_) < 0) coefficients = -coefficients;
    previous_ = coefficients;
    return rotation_from_unit_quaternion<double>(Eigen::Quaterniond{coefficients});
  }

  /// The rotation of the next quaternion, in a row of a table. Throws std::runtime_error with file:line unless its norm
  /// is 1 within `norm_tolerance`.
  [[nodiscard]] Sophus::SO3d next(const StampedTable& row, const Eigen::Quaterniond& q) {
    if (!is_unit(q)) row.fail(problem_of(q));
    return next(q);
  }

  /// The message about a quaternion that is not unit.
  [[nodiscard]] static std::string problem_of(const Eigen::Quaterniond& q) {
    return message("quaternion with w x y z = ", q.w(), ' ', q.x(), ' ', q.y(), ' ', q.z(), " has norm ", q.norm(),
                   ", expected 1 within ", norm_tolerance);
  }

 private:
  Eigen::Vector4d previous_ = Eigen::Vector4d::Zero();
};

}  // namespace splinertia::detail
