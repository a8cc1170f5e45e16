// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/detail/select.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia::detail {

/// sqrt(x² + y²) without overflow or underflow of the squares.
template <typename Scalar>
[[nodiscard]] Scalar plane_norm(const Scalar& x, const Scalar& y) {
  const Scalar scale = direction_scale<Scalar>(x, y, Scalar(0)), a = x * scale, b = y * scale;
  return square_root<Scalar>(a * a + b * b) / scale;
}

/// sin θ/ρ, where a ray at the angle θ from the optical axis appears at m = (x, y), at the radius ρ. `at_centre` where
/// both are zero.
template <typename Scalar>
[[nodiscard]] Scalar sine_by_radius(const Eigen::Vector3<Scalar>& ray, const Scalar& x, const Scalar& y,
                                    const Scalar& at_centre) {
  if (x == Scalar(0) && y == Scalar(0)) return at_centre;
  return plane_norm<Scalar>(ray.x(), ray.y()) / plane_norm<Scalar>(x, y);
}

/// ∂ray/∂m of a model whose image is rotationally symmetric. Along m the angle changes by `along` = dθ/dρ, across it the
/// ray turns about the axis by `across` = sin θ/ρ.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 3, 2> ray_jacobian_from_slopes(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                                   const Scalar& y, const Scalar& along,
                                                                   const Scalar& across) {
  const bool centre = x == Scalar(0) && y == Scalar(0);
  const Scalar rho = centre ? Scalar(1) : plane_norm<Scalar>(x, y), ex = centre ? rho : Scalar(x / rho), ey = y / rho;
  const Scalar radial = ray.z() * along, forward = -(across * along);
  // Close to the axis behind the camera the two differ so much that their sum does not hold both.
  Eigen::Matrix<Scalar, 3, 2> J;
  J << across * ey * ey + radial * ex * ex, (radial - across) * ex * ey,  //
      (radial - across) * ex * ey, across * ex * ex + radial * ey * ey,   //
      forward * x, forward * y;
  return J;
}

/// The same for models with dθ/dρ = (sin θ/ρ)²/slope.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 3, 2> symmetric_ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                                 const Scalar& y, const Scalar& at_centre,
                                                                 const Scalar& slope) {
  const Scalar across = sine_by_radius<Scalar>(ray, x, y, at_centre);
  // The slope is zero by underflow only, where the square beside it is zero too.
  const Scalar along = slope > Scalar(0) ? Scalar(across * across / slope) : Scalar(0);
  return ray_jacobian_from_slopes<Scalar>(ray, x, y, along, across);
}

}  // namespace splinertia::detail
