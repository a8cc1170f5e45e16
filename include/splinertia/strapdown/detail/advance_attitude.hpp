// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/group/detail/rotation.hpp>
#include <splinertia/group/sophus.hpp>

namespace splinertia::detail {

/// The product q r of unit quaternions, normalised; without that, rounding would let the norm drift from step to step.
template <typename Scalar>
[[nodiscard]] Sophus::SO3<Scalar> advance_attitude(const Eigen::Quaternion<Scalar>& q,
                                                   const Eigen::Quaternion<Scalar>& r) {
  const Eigen::Quaternion<Scalar> product = quaternion_product(q, r);
  // One Newton step for 1/|q|, which is accurate to rounding this close to 1.
  const Scalar scale = (Scalar(3) - product.squaredNorm()) / Scalar(2);
  return rotation_from_unit_quaternion(Eigen::Quaternion<Scalar>(product.coeffs() * scale));
}

}  // namespace splinertia::detail
