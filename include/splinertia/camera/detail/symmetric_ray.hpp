// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/detail/select.hpp>

namespace splinertia::detail {

/// sqrt(x² + y²) without overflow or underflow of the squares.
template <typename Scalar>
[[nodiscard]] Scalar plane_norm(const Scalar& x, const Scalar& y) {
  const Scalar scale = direction_scale<Scalar>(x, y, Scalar(0)), a = x * scale, b = y * scale;
  return square_root<Scalar>(a * a + b * b) / scale;
}

/// ∂ray/∂m of a model whose image is rotationally symmetric: a ray at the angle θ from the axis appears at m = (x, y), at
/// the radius ρ. Along m the angle changes by dθ/dρ = by_radius(sin θ/ρ), across it the ray turns about the axis by
/// sin θ/ρ, which is `at_centre` where both are zero.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 3, 2> symmetric_ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                                 const Scalar& y, const Scalar& at_centre,
                                                                 const auto& by_radius) {
  const bool centre = x == Scalar(0) && y == Scalar(0);
  const Scalar rho = centre ? Scalar(1) : plane_norm<Scalar>(x, y);
  const Scalar across = centre ? at_centre : Scalar(plane_norm<Scalar>(ray.x(), ray.y()) / rho);
  const Scalar slope = by_radius(across), along = ray.z() * slope, forward = -(across * slope);
  const Scalar ex = centre ? Scalar(1) : Scalar(x / rho), ey = y / rho;
  // Close to the axis behind the camera the two differ so much that their sum does not hold both.
  Eigen::Matrix<Scalar, 3, 2> J;
  J << across * ey * ey + along * ex * ex, (along - across) * ex * ey,  //
      (along - across) * ex * ey, across * ex * ex + along * ey * ey,   //
      forward * x, forward * y;
  return J;
}

}  // namespace splinertia::detail
