// SPDX-License-Identifier: MIT
/// The motion of a camera frame C, and of points seen from it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/detail/tangent_parts.hpp>
#include <splinertia/motion/motion.hpp>

namespace splinertia::detail {

template <typename Scalar, bool exists>
struct CameraRates {};
template <typename Scalar>
struct CameraRates<Scalar, true> {
  Eigen::Vector3<Scalar> omega, velocity;  ///< of C, in C: rad/s, m/s
};

/// The pose T_WC of a camera and, for D = 1, its velocity.
template <typename Scalar, int D>
struct CameraState : CameraRates<Scalar, (D >= 1)> {
  Eigen::Quaternion<Scalar> q_WC;
  Eigen::Vector3<Scalar> p_WC;

  /// A point of the world in C.
  [[nodiscard]] Eigen::Vector3<Scalar> in_camera(const Eigen::Vector3<Scalar>& point) const {
    return rotate_inverse<Scalar>(q_WC, point - p_WC);
  }
  /// The rate of a point in C that is at rest in the world.
  [[nodiscard]] Eigen::Vector3<Scalar> rate(const Eigen::Vector3<Scalar>& in_camera) const
    requires(D >= 1)
  {
    return in_camera.cross(this->omega) - this->velocity;
  }
};

/// The velocity of the origin of B, in B.
template <Pose G>
[[nodiscard]] inline Eigen::Vector3<ScalarOf<G>> body_velocity(const Motion<G, 1>& body) {
  const Eigen::Vector3<ScalarOf<G>> v = translational_part<G>(body.velocity);
  if constexpr (SplitPose<G>) {
    return rotate_inverse<ScalarOf<G>>(rotation(body.value).unit_quaternion(), v);
  } else {
    return v;
  }
}

/// The state of a camera at T_BC on a body.
template <int D, Pose G>
[[nodiscard]] inline CameraState<ScalarOf<G>, D> camera_state(const Motion<G, D>& body,
                                                              const Sophus::SE3<ScalarOf<G>>& T_BC) {
  using Scalar = ScalarOf<G>;
  const auto &q_WB = rotation(body.value).unit_quaternion(), &q_BC = T_BC.unit_quaternion();
  CameraState<Scalar, D> c;
  c.q_WC = quaternion_product<Scalar>(q_WB, q_BC);
  c.p_WC = position(body.value) + rotate<Scalar>(q_WB, T_BC.translation());
  if constexpr (D >= 1) {
    const Eigen::Vector3<Scalar> omega = rotational_part<G>(body.velocity);
    c.omega = rotate_inverse<Scalar>(q_BC, omega);
    c.velocity = rotate_inverse<Scalar>(q_BC, body_velocity<G>(body) + omega.cross(T_BC.translation()));
  }
  return c;
}

}  // namespace splinertia::detail
