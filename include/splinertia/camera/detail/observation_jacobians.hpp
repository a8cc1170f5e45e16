// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <splinertia/camera/camera.hpp>
#include <splinertia/camera/detail/camera_state.hpp>
#include <splinertia/camera/detail/shutter_times.hpp>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/motion.hpp>

namespace splinertia::detail {

// One base class per Jacobian of ObservationLinearization. The primary templates are empty.
template <typename Scalar, bool exists>
struct PoseJacobian {};
template <typename Scalar>
struct PoseJacobian<Scalar, true> {
  Eigen::Matrix<Scalar, 2, 6> pose_jacobian;
};

template <typename Scalar, int Order, bool exists>
struct ControlPointJacobian {};
template <typename Scalar, int Order>
struct ControlPointJacobian<Scalar, Order, true> {
  FixedArray<Eigen::Matrix<Scalar, 2, 6>, Order> control_point_jacobian;
  std::size_t first;
};

template <typename Scalar, bool exists>
struct LandmarkJacobian {};
template <typename Scalar>
struct LandmarkJacobian<Scalar, true> {
  Eigen::Matrix<Scalar, 2, 3> landmark_jacobian;
};

template <typename Scalar, bool exists>
struct ExtrinsicsJacobian {};
template <typename Scalar>
struct ExtrinsicsJacobian<Scalar, true> {
  Eigen::Matrix<Scalar, 2, 6> T_BC_jacobian;
};

template <typename Scalar, bool exists>
struct ClockOffsetJacobian {};
template <typename Scalar>
struct ClockOffsetJacobian<Scalar, true> {
  Eigen::Vector2<Scalar> clock_offset_jacobian;
};

template <typename Scalar, bool exists>
struct LineDelayJacobian {};
template <typename Scalar>
struct LineDelayJacobian<Scalar, true> {
  Eigen::Vector2<Scalar> line_delay_jacobian;
};

/// The time between two rows, and ∂t/∂(line delay) of the row of a pixel. Zero for a global shutter.
template <typename Scalar>
struct RowTimeSlope {
  Scalar by_row, by_delay;
};
template <typename Scalar>
[[nodiscard]] RowTimeSlope<Scalar> row_time_slope(const GlobalShutter&, const Scalar&, int) {
  return {Scalar(0), Scalar(0)};
}
template <typename Scalar, typename Delay, typename Stamp>
[[nodiscard]] RowTimeSlope<Scalar> row_time_slope(const RollingShutter<Delay, Stamp>& shutter, const Scalar& row,
                                                  int height) {
  const ShutterTimes<Scalar> times(shutter, height);
  return {times.line_delay, row - times.stamp_row};
}

/// ∂p_C/∂(pose of the body, right perturbation), where p_B is the point in the body:
///   SO3xR3   R_CB [p_B^, −R_BW]
///   SE3      R_CB [−I, p_B^]
template <Pose G>
[[nodiscard]] inline Eigen::Matrix<ScalarOf<G>, 3, 6> point_by_pose(const G& T_WB,
                                                                    const Eigen::Matrix3<ScalarOf<G>>& R_CB,
                                                                    const Eigen::Vector3<ScalarOf<G>>& p_B) {
  using Scalar = ScalarOf<G>;
  Eigen::Matrix<Scalar, 3, 6> J;
  if constexpr (SplitPose<G>) {
    J << times_hat<Scalar>(R_CB, p_B), -(R_CB * rotation_matrix_transposed<Scalar>(rotation(T_WB).unit_quaternion()));
  } else {
    J << -R_CB, times_hat<Scalar>(R_CB, p_B);
  }
  return J;
}

/// Fills in what `result`, an ObservationLinearization, has, and calls with_pose(d pixel/d pose) if the control points
/// are requested. False outside the model's domain.
template <Wrt wrt, Pose G, typename Camera>
[[nodiscard]] inline bool linearize_pixel(const Motion<G, 1>& body, const Camera& camera,
                                          const Eigen::Vector3<ScalarOf<G>>& landmark, auto& result,
                                          const auto& with_pose) {
  static_assert(!includes(wrt, Wrt::point), "the point in the camera is that of a model; ask for Wrt::landmark");
  using Scalar = ScalarOf<G>;
  constexpr Wrt of_model = includes(wrt, Wrt::parameters) ? Wrt::point | Wrt::parameters : Wrt::point;
  const auto state = camera_state<1>(body, camera.T_BC());
  const Eigen::Vector3<Scalar> p_C = state.in_camera(landmark);
  const auto projection = camera.model().template linearize<of_model>(p_C);
  if (!projection) return false;
  const Eigen::Matrix<Scalar, 2, 3>& by_point = projection->point_jacobian;
  result.pixel = projection->pixel;
  result.rate = by_point * state.rate(p_C);

  const auto time = row_time_slope<Scalar>(camera.shutter(), result.pixel.y(), camera.size().height);
  const Scalar slope = Scalar(1) - result.rate.y() * time.by_row;
  // d pixel/dθ = S ∂π/∂θ, and π̇/slope for the time itself.
  Eigen::Matrix2<Scalar> S = Eigen::Matrix2<Scalar>::Identity();
  S.col(1) += result.rate * (time.by_row / slope);
  if constexpr (includes(wrt, Wrt::clock_offset)) result.clock_offset_jacobian = result.rate / slope;
  if constexpr (includes(wrt, Wrt::line_delay)) result.line_delay_jacobian = result.rate * (time.by_delay / slope);
  if constexpr (includes(wrt, Wrt::parameters)) result.parameter_jacobian = S * projection->parameter_jacobian;

  const Eigen::Matrix<Scalar, 2, 3> by_moved_point = S * by_point;
  if constexpr (includes(wrt, Wrt::landmark)) {
    result.landmark_jacobian = by_moved_point * rotation_matrix_transposed<Scalar>(state.q_WC);
  }
  if constexpr (includes(wrt, Wrt::T_BC)) {
    result.T_BC_jacobian << -by_moved_point, by_moved_point * hat<Scalar>(p_C);
  }
  if constexpr (includes(wrt, Wrt::pose) || includes(wrt, Wrt::control_points)) {
    const Eigen::Vector3<Scalar> p_B = camera.T_BC() * p_C;
    const Eigen::Matrix3<Scalar> R_CB = rotation_matrix_transposed<Scalar>(camera.T_BC().unit_quaternion());
    const Eigen::Matrix<Scalar, 2, 6> by_pose = by_moved_point * point_by_pose<G>(body.value, R_CB, p_B);
    if constexpr (includes(wrt, Wrt::pose)) result.pose_jacobian = by_pose;
    if constexpr (includes(wrt, Wrt::control_points)) with_pose(by_pose);
  }
  return true;
}

}  // namespace splinertia::detail
