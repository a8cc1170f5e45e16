// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <splinertia/group/sophus.hpp>
#include <splinertia/io/stamped_table.hpp>

namespace splinertia {

/// Makes rotations of the quaternions in the rows of a table, one after the other. Each is normalised and gets the sign
/// nearer to its predecessor (the first keeps its own), so that the four numbers are continuous where the motion is.
///
/// Throws std::runtime_error with file:line for a quaternion whose norm is not 1 within `norm_tolerance`. A norm of 1
/// to within `exact_norm` is what arithmetic leaves: such a quaternion is taken as it is, so that what the writers
/// wrote reads back to the same bits.
class QuaternionTrack {
 public:
  static constexpr double norm_tolerance = 1e-3;
  static constexpr double exact_norm = 1e-12;

  [[nodiscard]] Sophus::SO3d next(const StampedTable& row, const Eigen::Quaterniond& q) {
    const double norm = q.norm();
    if (!(std::abs(norm - 1) <= norm_tolerance)) {
      row.fail("quaternion with w x y z = ", q.w(), ' ', q.x(), ' ', q.y(), ' ', q.z(), " has norm ", norm,
               ", expected 1 within ", norm_tolerance);
    }
    Eigen::Vector4d coefficients = q.coeffs();
    if (std::abs(norm - 1) > exact_norm) coefficients /= norm;
    if (coefficients.dot(previous_) < 0) coefficients = -coefficients;
    previous_ = coefficients;
    return rotation_from_unit_quaternion<double>(Eigen::Quaterniond{coefficients});
  }

 private:
  Eigen::Vector4d previous_ = Eigen::Vector4d::Zero();
};

}  // namespace splinertia
