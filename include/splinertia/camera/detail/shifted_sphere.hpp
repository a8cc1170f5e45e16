// SPDX-License-Identifier: MIT
/// The unit sphere seen from a centre that is shifted by ξ along the optical axis: a direction of length d becomes
/// (x, y, z + ξ d). Models of central catadioptric and fisheye cameras begin with it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/detail/select.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia::detail {

/// At ξ = −1 the centre lies on the sphere, in the direction in which the camera looks.
template <typename Scalar>
void require_shift(const char* whose, const Scalar& xi) {
  require_factor(whose, "xi", xi);
  require(xi > Scalar(-1), whose, "xi", xi, "a number > -1");
}

/// The h for which the map is one-to-one where z > −h d. From outside the sphere (ξ > 1) only the nearer part of it is
/// visible, up to the circle where the rays touch it. Otherwise all of it is, and h > 1.
template <typename Scalar>
[[nodiscard]] Scalar shifted_border(const Scalar& xi) {
  return xi > Scalar(1) ? Scalar(1) / xi : Scalar(2);
}

/// The direction that is seen as (x, y, z) from the shifted centre. Nothing if that ray misses the visible part of the
/// sphere. The squares of x, y, z must neither overflow nor all underflow.
template <typename Scalar>
[[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unshift_sphere(const Scalar& x, const Scalar& y, const Scalar& z,
                                                                   const Scalar& xi) {
  const Scalar square = x * x + y * y, zz = z * z, rest = (Scalar(1) - xi) * (Scalar(1) + xi);
  const Scalar inside = zz + rest * square;
  if (!(inside > Scalar(0)) || (!(xi < Scalar(1)) && !(z > Scalar(0)))) return std::nullopt;
  // The distance to the sphere along the ray. Of its two equal forms one subtracts.
  const Scalar root = square_root(inside), along = z * xi;
  const Scalar k = along < Scalar(0) ? rest / (root - along) : (along + root) / (square + zz);
  return Eigen::Vector3<Scalar>(k * x, k * y, k * z - xi);
}

/// The angle from the optical axis of the direction that is seen at the angle `seen` from the shifted centre, or of the
/// border where none is.
template <typename Scalar>
[[nodiscard]] Scalar unshift_angle(const Scalar& seen, const Scalar& xi) {
  using std::acos, std::asin, std::sin;
  const Scalar share = xi * sin(seen);
  if (xi < Scalar(1)) return seen + asin(share);
  const Scalar border = acos(Scalar(-1) / xi);
  if (!(share < Scalar(1)) || !(seen < pi_of<Scalar>() / Scalar(2))) return border;
  return seen + asin(share);
}

}  // namespace splinertia::detail
