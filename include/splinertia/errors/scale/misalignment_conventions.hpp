// SPDX-License-Identifier: MIT
/// Conversions between the matrix of misalignment.hpp and the conventions of calibration programs and data sheets.
#pragma once

#include <Eigen/Geometry>
#include <splinertia/errors/scale/misalignment.hpp>
#include <splinertia/group/lie_group.hpp>

namespace splinertia {

namespace detail {

/// The matrix as Kalibr splits it (imu.yaml of the scale-misalignment model): scale_and_shear·rotation.
template <typename Scalar>
struct KalibrMisalignment {
  Eigen::Matrix3<Scalar> scale_and_shear;  ///< Kalibr's M: lower triangular, scale factors (near 1) on the diagonal
  Eigen::Matrix3<Scalar> rotation;         ///< Kalibr's C_gyro_i: from the IMU's axes to the sensor's
};

}  // namespace detail

/// The matrix M·C of Kalibr's parts. Kalibr's gyroscope reads M·C·ω + A·C·f + bias + noise (its A·C is the
/// GSensitivity), its accelerometer M·f + bias + noise.
template <typename Scalar>
[[nodiscard]] Misalignment<Scalar> misalignment_from_kalibr(
    const Eigen::Matrix3<Scalar>& scale_and_shear,
    const Eigen::Matrix3<Scalar>& rotation = Eigen::Matrix3<Scalar>::Identity()) {
  return Eigen::Matrix3<Scalar>(scale_and_shear * rotation);
}

/// Splits a matrix into Kalibr's parts by orthogonalising the rows (Gram–Schmidt); the first row keeps its direction.
/// The rotation is proper. If the matrix mirrors, the last scale factor is negative.
template <typename Scalar>
[[nodiscard]] detail::KalibrMisalignment<Scalar> split_misalignment(const Misalignment<Scalar>& misalignment) {
  const Eigen::Matrix3<Scalar>& m = misalignment.matrix;
  const Eigen::Vector3<Scalar> x = m.row(0).transpose().normalized();
  const Eigen::Vector3<Scalar> second = m.row(1).transpose();
  const Eigen::Vector3<Scalar> y = (second - x * x.dot(second)).normalized();
  detail::KalibrMisalignment<Scalar> parts;
  parts.rotation.row(0) = x.transpose();
  parts.rotation.row(1) = y.transpose();
  parts.rotation.row(2) = x.cross(y).transpose();
  parts.scale_and_shear = (m * parts.rotation.transpose()).template triangularView<Eigen::Lower>();
  return parts;
}

/// The matrix from percentages, as in data sheets: scale factor errors on the diagonal, cross-axis sensitivities (how
/// much the row's axis senses of the column's) off it.
template <typename Scalar>
[[nodiscard]] Misalignment<Scalar> misalignment_from_percent(const Eigen::Matrix3<Scalar>& percent) {
  return Eigen::Matrix3<Scalar>(Eigen::Matrix3<Scalar>::Identity() + percent / Scalar(100));
}

/// The inverse of misalignment_from_percent().
template <typename Scalar>
[[nodiscard]] Eigen::Matrix3<Scalar> misalignment_percent(const Misalignment<Scalar>& misalignment) {
  return (misalignment.matrix - Eigen::Matrix3<Scalar>::Identity()) * Scalar(100);
}

}  // namespace splinertia
