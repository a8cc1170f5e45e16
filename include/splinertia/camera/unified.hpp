// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <splinertia/camera/detail/blended_projection.hpp>
#include <splinertia/camera/detail/focal_model.hpp>
#include <splinertia/camera/detail/model_name.hpp>
#include <splinertia/camera/detail/plane_distortion.hpp>
#include <splinertia/camera/detail/shifted_sphere.hpp>
#include <splinertia/camera/detail/symmetric_ray.hpp>
#include <splinertia/camera/distortion/no_distortion.hpp>
#include <splinertia/camera/distortion/radial_tangential.hpp>
#include <splinertia/camera/distortion/rational.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia {

namespace detail {

/// (x, y) / (z + ξ d), d = |(x, y, z)|, distorted.
template <typename Distortion>
class UnifiedBody {
 public:
  using Scalar = typename Distortion::Scalar;
  static constexpr int count = 1 + Distortion::count, leading = 1;
  static constexpr bool needs_scale = true;
  using Parameters = Eigen::Matrix<Scalar, count, 1>;

  UnifiedBody(const Scalar& xi, const Distortion& distortion) : xi_(xi), distortion_(distortion) {
    require_shift("Unified", xi);
    border_ = shifted_border(xi);
  }

  [[nodiscard]] Parameters parameters() const {
    Parameters p;
    p << xi_, distortion_.parameters();
    return p;
  }
  [[nodiscard]] static UnifiedBody from(const Parameters& p) {
    return {p[0], Distortion::from(p.template tail<count - 1>())};
  }
  [[nodiscard]] Scalar largest_angle() const {
    using std::atan;
    return unshift_angle(Scalar(atan(distortion_.limit())), xi_);
  }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline PlanePoint<T, count, wrt> map(const T& x, const T& y,
                                                                              const T& z) const {
    const T xi(xi_), square = x * x + y * y, d = square_root<T>(square + z * z);
    const BlendedLength<T> shifted(xi, T(1), square, z, d);
    const T denominator = shifted.value, scale = T(1) / denominator, u = x * scale, v = y * scale;
    constexpr Wrt needed = wrt == Wrt::nothing ? wrt : wrt | Wrt::point;
    const auto distorted = distortion_.template distort<needed, T>(u, v);
    PlanePoint<T, count, wrt> m;
    m.x = distorted.x;
    m.y = distorted.y;
    m.valid = both<T>(both<T>(distorted.valid, less<T>(T(0), denominator)), less<T>(-(T(border_) * d), z));
    if constexpr (includes(wrt, Wrt::point)) {
      const Eigen::Matrix2<T> D = distorted.by_point * scale;
      const T shift = xi / d, by_z = shifted.slope;
      const T along_x = D(0, 0) * u + D(0, 1) * v, along_y = D(1, 0) * u + D(1, 1) * v;
      const T cx = shift * x, cy = shift * y;
      m.by_point(0, 0) = D(0, 0) - along_x * cx;
      m.by_point(0, 1) = D(0, 1) - along_x * cy;
      m.by_point(0, 2) = -(along_x * by_z);
      m.by_point(1, 0) = D(1, 0) - along_y * cx;
      m.by_point(1, 1) = D(1, 1) - along_y * cy;
      m.by_point(1, 2) = -(along_y * by_z);
    }
    if constexpr (includes(wrt, Wrt::parameters)) {
      const Eigen::Matrix2<T>& D = distorted.by_point;
      const T by_xi = -(d * scale);
      m.by_parameters.col(0) << by_xi * (D(0, 0) * u + D(0, 1) * v), by_xi * (D(1, 0) * u + D(1, 1) * v);
      if constexpr (count > 1) {
        m.by_parameters.template rightCols<count - 1>() = distorted.by_parameters;
      }
    }
    return m;
  }

  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unmap(const Scalar& x, const Scalar& y) const {
    const auto m = distortion_.undistort(x, y);
    if (!m) return std::nullopt;
    const Scalar one = direction_scale<Scalar>(m->x(), m->y(), Scalar(1));
    return unshift_sphere<Scalar>(m->x() * one, m->y() * one, one, xi_);
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 3, 2> ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                         const Scalar& y) const {
    const Scalar one(1), slope = one + xi_ * ray.z();
    if constexpr (Distortion::count == 0) {
      return symmetric_ray_jacobian<Scalar>(ray, x, y, one + xi_, slope);
    } else {
      const Scalar depth = larger<Scalar>(ray.z() + xi_, std::numeric_limits<Scalar>::epsilon());
      const Scalar u = ray.x() / depth, v = ray.y() / depth;
      return symmetric_ray_jacobian<Scalar>(ray, u, v, one + xi_, slope) *
             undistorted_jacobian<Scalar>(distortion_, u, v);
    }
  }

 private:
  Scalar xi_, border_;
  [[no_unique_address]] Distortion distortion_;
};

}  // namespace detail

/// The unified model of central catadioptric cameras (Mei, Rives, "Single view point omnidirectional camera calibration
/// from planar grids", ICRA 2007), Kalibr's `omni`: a point is projected to the unit sphere, and from a centre that is
/// shifted by ξ to the image plane, (x, y) / (z + ξ d) with d = |(x, y, z)|, and distorted there by NoDistortion,
/// RadialTangential or Rational. Parameters: ξ, fx, fy, cx, cy in pixels, and those of the distortion.
///
/// Its domain is z > −ξ d, or z > −d/ξ for ξ > 1, as far as the distortion's domain extends.
template <typename Distortion>
class Unified
    : public detail::FocalModel<Unified<Distortion>, detail::UnifiedBody<Distortion>, typename Distortion::Scalar> {
  using Body = detail::UnifiedBody<Distortion>;
  using Base = detail::FocalModel<Unified, Body, typename Distortion::Scalar>;

 public:
  using Scalar = typename Distortion::Scalar;
  static constexpr const char* name = detail::model_name<"omni-", Distortion>.data();

  /// Throws std::invalid_argument unless all numbers are finite, fx and fy positive and ξ > −1.
  Unified(const Scalar& xi, const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy,
          const Distortion& distortion)
      : Unified(fx, fy, cx, cy, Body(xi, distortion)) {}

 private:
  friend Base;
  Unified(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Body& body)
      : Base("Unified", fx, fy, cx, cy, body) {}
};

}  // namespace splinertia
