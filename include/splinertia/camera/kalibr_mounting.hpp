// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <splinertia/camera/camera.hpp>
#include <splinertia/camera/kalibr_camera.hpp>
#include <splinertia/camera/shutter.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/group/sophus.hpp>
#include <stdexcept>

namespace splinertia {

/// The pose whose matrix a file has, its rotation made orthogonal. Throws std::invalid_argument unless the last row is
/// 0 0 0 1, all numbers are finite and the rotation is orthogonal to 1e-4.
template <typename Scalar = double>
[[nodiscard]] Sophus::SE3<Scalar> pose_of_matrix(const Eigen::Matrix4d& T) {
  detail::require_all_finite("pose_of_matrix", "the matrix, column by column",
                             Eigen::Map<const Eigen::Matrix<double, 16, 1>>(T.data()));
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  const double deviation = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation < 1e-4) || !(R.determinant() > 0)) {
    detail::refuse<std::invalid_argument>("pose_of_matrix: a rotation has the determinant ", R.determinant(),
                                          " and deviates from an orthogonal matrix by ", deviation,
                                          ", expected 1 and at most 0.0001");
  }
  if (T.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    detail::refuse<std::invalid_argument>("pose_of_matrix: the last row is ", T(3, 0), ' ', T(3, 1), ' ', T(3, 2), ' ',
                                          T(3, 3), ", expected 0 0 0 1");
  }
  return {Eigen::Quaterniond(R).normalized().template cast<Scalar>(), T.topRightCorner<3, 1>().template cast<Scalar>()};
}

/// The inverse of the matrix of a pose. The numbers of the rotation stay as they are.
[[nodiscard]] inline Eigen::Matrix4d inverse_of_pose(const Eigen::Matrix4d& T) {
  Eigen::Matrix4d inverse = Eigen::Matrix4d::Identity();
  inverse.topLeftCorner<3, 3>() = T.topLeftCorner<3, 3>().transpose();
  inverse.topRightCorner<3, 1>() = -(inverse.topLeftCorner<3, 3>() * T.topRightCorner<3, 1>());
  return inverse;
}

/// T_BC, the pose of the camera on the IMU: the inverse of T_cam_imu. Throws std::invalid_argument if the entry has
/// none, and as pose_of_matrix() does.
template <typename Scalar = double>
[[nodiscard]] Sophus::SE3<Scalar> T_BC_of(const KalibrCamera& camera) {
  if (!camera.T_cam_imu) {
    detail::refuse<std::invalid_argument>("KalibrCamera: no T_cam_imu, expected one");
  }
  return pose_of_matrix<Scalar>(*camera.T_cam_imu).inverse();
}

/// T_cam_imu of a camera at T_BC.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix4d T_cam_imu_of(const Sophus::SE3<Scalar>& T_BC) {
  return T_BC.inverse().matrix().template cast<double>();
}

/// The entry of a camera: its model, size, T_cam_imu and, for a rolling shutter, line_delay. Kalibr knows no stamp but
/// that of the row that is read first.
template <typename Model, typename Shutter, typename Region>
[[nodiscard]] KalibrCamera to_kalibr(const Camera<Model, Shutter, Region>& camera) {
  KalibrCamera entry = to_kalibr(camera.model());
  entry.resolution = {camera.size().width, camera.size().height};
  entry.T_cam_imu = T_cam_imu_of(camera.T_BC());
  if constexpr (detail::is_rolling<Shutter>) entry.line_delay = static_cast<double>(camera.shutter().line_delay);
  return entry;
}

/// The camera of an entry, with a shutter of your choice, as RollingShutter{*entry.line_delay}. Throws
/// std::invalid_argument as from_kalibr(), T_BC_of() and the constructors do.
template <CameraModel Model, typename Shutter = GlobalShutter>
[[nodiscard]] Camera<Model, Shutter> camera_from_kalibr(const KalibrCamera& entry, const Shutter& shutter = {}) {
  return {from_kalibr<Model>(entry), ImageSize{entry.resolution[0], entry.resolution[1]},
          T_BC_of<typename Model::Scalar>(entry), shutter};
}

}  // namespace splinertia
