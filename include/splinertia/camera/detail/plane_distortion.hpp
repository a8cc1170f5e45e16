// SPDX-License-Identifier: MIT
/// Distortions of the image plane: of a point m of the undistorted image of focal length 1. A distortion D has
///   D::count, d.parameters(), D::from(v)   its parameters
///   d.limit()                              the radius |m| at which the domain ends, without tangential terms
///   d.distort<wrt>(x, y)                   the distorted point, whether m is in the domain, and derivatives
///   d.undistort(x, y)                      the inverse, if the point is in the image of the domain
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <concepts>
#include <limits>
#include <optional>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/camera/detail/image_point.hpp>
#include <splinertia/camera/detail/increasing_inverse.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/select.hpp>
#include <splinertia/detail/square_root.hpp>
#include <type_traits>

namespace splinertia::detail {

/// A distorted point, with what was requested of its derivatives with respect to the undistorted point and to the
/// Count parameters. `valid`: the undistorted point is in the domain.
template <typename T, int Count, Wrt wrt>
using Distorted = ImagePoint<T, 2, Count, wrt>;

/// A radial factor g(s), s = |m|², and tangential terms (Brown 1966), as OpenCV defines them:
///   x' = x g + 2 p1 x y + p2 (s + 2 x²),   y' = y g + p1 (s + 2 y²) + 2 p2 x y
/// `slope` is dg/ds. Of by_parameters the columns 2 and 3, of p1 and p2, are set.
template <Wrt wrt, int Count, typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Distorted<T, Count, wrt> distort_brown(const T& x, const T& y, const T& g,
                                                                                     const T& slope, const T& p1,
                                                                                     const T& p2) {
  Distorted<T, Count, wrt> m;
  const T xx = x * x, yy = y * y, xy = x * y, two_xy = xy + xy, s = xx + yy;
  const T tx = s + (xx + xx), ty = s + (yy + yy);
  m.x = x * g + (p1 * two_xy + p2 * tx);
  m.y = y * g + (p1 * ty + p2 * two_xy);
  if constexpr (includes(wrt, Wrt::point)) {
    const T twice = slope + slope, p1x = p1 * x, p1y = p1 * y, p2x = p2 * x, p2y = p2 * y;
    const T mixed = twice * xy + T(2) * (p1x + p2y);
    m.by_point(0, 0) = g + twice * xx + (T(2) * p1y + T(6) * p2x);
    m.by_point(0, 1) = m.by_point(1, 0) = mixed;
    m.by_point(1, 1) = g + twice * yy + (T(6) * p1y + T(2) * p2x);
  }
  if constexpr (includes(wrt, Wrt::parameters)) {
    m.by_parameters(0, 2) = m.by_parameters(1, 3) = two_xy;
    m.by_parameters(1, 2) = ty;
    m.by_parameters(0, 3) = tx;
  }
  return m;
}

/// The derivative of the undistorted point (x, y) by its distorted point. Zero where its inverse overflows.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix2<Scalar> undistorted_jacobian(const auto& distortion, const Scalar& x, const Scalar& y) {
  const Eigen::Matrix2<Scalar> D = distortion.template distort<Wrt::point, Scalar>(x, y).by_point;
  const Scalar size = D.cwiseAbs().maxCoeff();
  if (!is_finite(size) || !all_finite(D)) return Eigen::Matrix2<Scalar>::Zero();
  return (D / size).inverse() / size;  // the determinant of D itself may overflow
}

/// A solution m of distort(m) = target in the domain, by Newton's method from `start` until the residual no longer falls.
/// Steps that leave the domain or increase the residual are halved. Nothing if the residual stays above rounding.
template <typename Scalar>
[[nodiscard]] std::optional<Eigen::Vector2<Scalar>> undistort_from(const auto& distortion,
                                                                   const Eigen::Vector2<Scalar>& target,
                                                                   const Eigen::Vector2<Scalar>& start) {
  using Vector = Eigen::Vector2<Scalar>;
  const auto at = [&](const Vector& m) { return distortion.template distort<Wrt::point, Scalar>(m.x(), m.y()); };
  const auto residual = [&](const auto& d) { return Vector(d.x - target.x(), d.y - target.y()); };
  const Scalar rounding = Scalar(32) * std::numeric_limits<Scalar>::epsilon() * (target.norm() + start.norm());
  Vector m = start;
  auto here = at(m);
  Vector error = residual(here);
  for (int i = 0; i < 100 && error.squaredNorm() > Scalar(0); ++i) {
    Vector step = here.by_point.inverse() * error;
    const int most_trials = error.norm() <= rounding ? 1 : 12;
    int trial = 0;
    for (; trial < most_trials; ++trial, step /= Scalar(2)) {
      const Vector next = m - step;
      const auto there = at(next);
      const Vector left = residual(there);
      if (!there.valid || !(left.squaredNorm() < error.squaredNorm())) continue;
      m = next;
      here = there;
      error = left;
      break;
    }
    if (trial == most_trials) break;
  }
  if (!here.valid || !(error.norm() <= rounding)) return std::nullopt;
  if constexpr (!std::floating_point<Scalar>) m -= here.by_point.inverse() * error;  // has the derivatives of a Jet
  return m;
}

/// The point with |m| = border whose image lies in the direction of the target.
template <typename Scalar>
[[nodiscard]] Eigen::Vector2<Scalar> border_towards(const auto& distortion, const Eigen::Vector2<Scalar>& target,
                                                    const Scalar& border) {
  using Vector = Eigen::Vector2<Scalar>;
  Vector m = target.normalized() * border;
  for (int i = 0; i < 3; ++i) {
    const auto d = distortion.template distort<Wrt::nothing, Scalar>(m.x(), m.y());
    const Vector across(-m.y(), m.x());
    const Scalar missed = across.dot(Vector(d.x - target.x(), d.y - target.y())) / across.dot(across);
    m = (m - across * (missed * (border / target.norm()))).normalized() * border;
  }
  return m;
}

/// The inverse of a distortion that is nearly radial: (x, y) = distort(m). `radial(r, slope)` is the distorted radius
/// without tangential terms. It increases on [0, limit] to `end`. `tangential` is |p1| + |p2|. First the radial part is
/// inverted. Then Newton's method in two dimensions adds the tangential part.
///
/// Tangential terms shift the line on which the image folds: on one side it lies inside the domain, which is defined by
/// the radial part alone. Two points of the domain then have the same pixel, and one of them is returned: the outer one,
/// if it is about as far beyond the fold as the inner one is before it. A fold can only be where the slope of the radius
/// is of the size of the tangential terms' derivatives, at most 6 tangential |m|.
template <typename Scalar>
[[nodiscard]] std::optional<Eigen::Vector2<Scalar>> undistort_brown(const auto& distortion, const auto& radial,
                                                                    const Scalar& x, const Scalar& y,
                                                                    const Scalar& limit, const Scalar& end,
                                                                    const Scalar& tangential) {
  using Vector = Eigen::Vector2<Scalar>;
  const Vector target(x, y);
  const Scalar squared = target.squaredNorm(), epsilon = std::numeric_limits<Scalar>::epsilon();
  if (squared < smallest_square<Scalar>()) return target;  // distortion is of higher order
  const Scalar radius = square_root(squared);
  if (!is_finite(radius) || (tangential == Scalar(0) && !(radius < end))) return std::nullopt;
  const Scalar border = limit * (Scalar(1) - Scalar(8) * epsilon);
  const Scalar r = radius < end ? increasing_inverse<Scalar>(radial, radius, Scalar(0), limit,
                                                             radius < limit ? radius : Scalar(limit / Scalar(2)))
                                : border;
  const Vector first = target * (r / radius);
  // A Jet differentiates by the tangential terms.
  if (std::floating_point<Scalar> && tangential == Scalar(0)) return first;
  const auto m = undistort_from<Scalar>(distortion, target, first);
  if (!m && limit < (std::numeric_limits<Scalar>::max)()) {
    return undistort_from<Scalar>(distortion, target, border_towards<Scalar>(distortion, target, border));
  }
  if (!m) return m;
  const Scalar size = m->norm();
  Scalar slope;
  (void)radial(size, slope);
  if (slope > Scalar(24) * tangential * size) return m;  // no fold is near
  // The image folds where the determinant is zero. The other point with this pixel is about as far beyond the fold.
  const auto determinant = [&](const Vector& at) {
    return Scalar(distortion.template distort<Wrt::point, Scalar>(at.x(), at.y()).by_point.determinant());
  };
  const Scalar little = square_root(epsilon), here = determinant(*m);
  const Scalar to_fold = little * here / (here - determinant(*m * (Scalar(1) + little)));
  if (!(Scalar(0) < to_fold && to_fold < Scalar(1) / Scalar(8))) return m;
  const auto other = undistort_from<Scalar>(distortion, target, Vector(*m * (Scalar(1) + Scalar(2) * to_fold)));
  return other && other->norm() > size ? other : m;
}

}  // namespace splinertia::detail
