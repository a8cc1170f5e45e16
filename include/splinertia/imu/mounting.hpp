// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/require.hpp>
#include <splinertia/group/pose.hpp>
#include <splinertia/group/with_scalar.hpp>

namespace splinertia {

/// Where an IMU is in the body that carries it. By default it is the body frame itself.
template <typename Scalar = double>
struct Mounting {
  Sophus::SO3<Scalar> R_BI{};                                    ///< rotates vectors from the IMU's axes to the body's
  Eigen::Vector3<Scalar> p_BI = Eigen::Vector3<Scalar>::Zero();  ///< the IMU's origin in the body (lever arm), m
};

template <typename Scalar>
Mounting(const Sophus::SO3<Scalar>&) -> Mounting<Scalar>;
template <typename Scalar, typename Position>
Mounting(const Sophus::SO3<Scalar>&, const Position&) -> Mounting<Scalar>;

namespace detail {

/// Throws std::invalid_argument unless the mounting is finite.
template <typename Scalar>
void require_finite(const char* whose, const Mounting<Scalar>& mounting) {
  require_all_finite(whose, "the lever arm p_BI", mounting.p_BI);
  require_all_finite(whose, "the rotation R_BI", mounting.R_BI.unit_quaternion().coeffs());
}

/// The mounting with numbers of type S.
template <typename S, typename Scalar>
[[nodiscard]] inline Mounting<S> with_scalar(const Mounting<Scalar>& mounting) {
  return {with_scalar<S>(mounting.R_BI), with_scalar<S>(mounting.p_BI)};
}

}  // namespace detail

/// The pose T_WI of the IMU on a body with pose T_WB: R_WB R_BI, p_WB + R_WB p_BI.
template <Pose G>
[[nodiscard]] G imu_pose(const G& body, const Mounting<ScalarOf<G>>& mounting) {
  using SO3 = GroupTraits<Sophus::SO3<ScalarOf<G>>>;
  return make_pose<G>(SO3::compose(rotation(body), mounting.R_BI),
                      position(body) + detail::rotate<ScalarOf<G>>(rotation(body).unit_quaternion(), mounting.p_BI));
}

}  // namespace splinertia
