// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/camera/detail/image_point.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/detail/select.hpp>
#include <splinertia/detail/square_root.hpp>
#include <type_traits>
#include <utility>

namespace splinertia::detail {

/// Coordinates m on the image plane of focal length 1.
template <typename T, int Count, Wrt wrt>
using PlanePoint = ImagePoint<T, 3, Count, wrt>;

/// A camera model of the form pixel = (fx mx + cx, fy my + cy). Body, for the scalar Scalar, gives m:
///   Body::count                      the number of its parameters
///   Body::leading                    how many of them stand before fx in parameters(); the others stand behind cy
///   Body::needs_scale                whether map() squares coordinates of the point
///   body.parameters(), Body::from(v) as a vector and back; from() throws std::invalid_argument for an empty domain
///   body.map<wrt>(x, y, z)           PlanePoint<T, count, wrt> of a direction, which direction_scale() has scaled if needed
///   body.unmap(mx, my)               the direction, of any length, if (mx, my) is in the image of the domain
///   body.largest_angle()             the angle from the optical axis at which the domain ends
///   body.ray_jacobian(ray, mx, my)   ∂ray/∂m of the ray, of length 1, that unmap(mx, my) found
template <typename Model, typename BodyType, typename ScalarType>
class FocalModel {
 public:
  using Scalar = ScalarType;
  using Body = BodyType;
  static constexpr int parameter_count = 4 + Body::count;
  using Parameters = Eigen::Matrix<Scalar, parameter_count, 1>;

  [[nodiscard]] const Scalar& fx() const { return fx_; }
  [[nodiscard]] const Scalar& fy() const { return fy_; }
  [[nodiscard]] const Scalar& cx() const { return cx_; }
  [[nodiscard]] const Scalar& cy() const { return cy_; }

  [[nodiscard]] Parameters parameters() const {
    constexpr int before = Body::leading, behind = Body::count - before;
    const Eigen::Matrix<Scalar, Body::count, 1> of_body = body_.parameters();
    Parameters all;
    all.template head<before>() = of_body.template head<before>();
    all.template segment<4>(before) << fx_, fy_, cx_, cy_;
    all.template tail<behind>() = of_body.template tail<behind>();
    return all;
  }
  /// Throws std::invalid_argument as the constructors do.
  [[nodiscard]] static Model from_parameters(const Parameters& p) {
    constexpr int before = Body::leading, behind = Body::count - before;
    Eigen::Matrix<Scalar, Body::count, 1> of_body;
    of_body.template head<before>() = p.template head<before>();
    of_body.template tail<behind>() = p.template tail<behind>();
    return Model(p[before], p[before + 1], p[before + 2], p[before + 3], Body::from(of_body));
  }

  /// The angle from the optical axis at which the domain ends, rad. Tangential distortion is not considered.
  [[nodiscard]] Scalar largest_angle() const { return body_.largest_angle(); }

  /// The pixel of a point, or nothing outside the domain.
  [[nodiscard]] std::optional<Eigen::Vector2<Scalar>> project(const Eigen::Vector3<Scalar>& point) const {
    Projection<Scalar, parameter_count, Wrt::nothing> p;
    if (!project_one(point, p)) return std::nullopt;
    return p.pixel;
  }

  /// The pixel of a point with its Jacobians, or nothing outside the domain.
  template <Wrt wrt>
  [[nodiscard]] std::optional<Projection<Scalar, parameter_count, wrt>> linearize(
      const Eigen::Vector3<Scalar>& point) const {
    std::optional<Projection<Scalar, parameter_count, wrt>> p(std::in_place);  // filled in place: copies cost a tenth
    if (!project_one(point, *p)) p.reset();
    return p;
  }

  /// The ray, of length 1, of the points that have this pixel. Nothing outside the image of the domain.
  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unproject(const Eigen::Vector2<Scalar>& pixel) const {
    const Scalar x = (pixel.x() - cx_) / fx_, y = (pixel.y() - cy_) / fy_;
    if (!is_finite(x) || !is_finite(y)) return std::nullopt;
    const std::optional<Eigen::Vector3<Scalar>> ray = body_.unmap(x, y);
    if (!ray) return std::nullopt;
    const Eigen::Vector3<Scalar> scaled = *ray * direction_scale<Scalar>(ray->x(), ray->y(), ray->z());
    return scaled / square_root<Scalar>(scaled.squaredNorm());
  }

  /// The ray with its Jacobian with respect to the pixel.
  [[nodiscard]] std::optional<Ray<Scalar>> linearize_ray(const Eigen::Vector2<Scalar>& pixel) const {
    const auto direction = unproject(pixel);
    if (!direction) return std::nullopt;
    const Scalar x = (pixel.x() - cx_) / fx_, y = (pixel.y() - cy_) / fy_;
    Ray<Scalar> ray{*direction, body_.ray_jacobian(*direction, x, y)};
    ray.pixel_jacobian.col(0) /= fx_;
    ray.pixel_jacobian.col(1) /= fy_;
    return ray;
  }

  /// The projections of a SIMD pack of points, and which are in the domain.
  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Mask<T> project_lanes(const T& x, const T& y, const T& z,
                                                                      Projection<T, parameter_count, wrt>& p) const {
    const T scale = Body::needs_scale ? direction_scale<T>(x, y, z) : T(1);
    const T sx = x * scale, sy = y * scale, sz = z * scale;
    const Mask<T> valid = project_scaled<wrt, T>(sx, sy, sz, p);
    if constexpr (includes(wrt, Wrt::point) && Body::needs_scale) p.point_jacobian *= scale;
    return both<T>(valid, finite_lanes<T>(Body::needs_scale ? T(sx + sy + sz) : z));
  }

 protected:
  FocalModel(const char* name, const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Body& body)
      : fx_(fx), fy_(fy), cx_(cx), cy_(cy), body_(body) {
    require_positive(name, "fx", fx);
    require_positive(name, "fy", fy);
    require_finite(name, "cx", cx);
    require_finite(name, "cy", cy);
  }

 private:
  template <Wrt wrt>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline bool project_one(const Eigen::Vector3<Scalar>& point,
                                                                 Projection<Scalar, parameter_count, wrt>& p) const {
    const Scalar &x = point.x(), &y = point.y(), &z = point.z();
    if constexpr (Body::needs_scale && std::is_floating_point_v<Scalar>) {
      const Scalar square = x * x + y * y + z * z;
      if (!(square > smallest_square<Scalar>() && square < Scalar(1) / smallest_square<Scalar>())) {
        return project_extreme(point, p);
      }
      return project_scaled<wrt, Scalar>(x, y, z, p);
    } else {
      return project_scaled<wrt, Scalar>(x, y, z, p) && is_finite(z);
    }
  }
  template <Wrt wrt>
  [[nodiscard]] SPLINERTIA_COLD bool project_extreme(const Eigen::Vector3<Scalar>& point,
                                                     Projection<Scalar, parameter_count, wrt>& p) const {
    return project_lanes<wrt, Scalar>(point.x(), point.y(), point.z(), p);
  }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Mask<T> project_scaled(const T& x, const T& y, const T& z,
                                                                       Projection<T, parameter_count, wrt>& p) const {
    const auto m = body_.template map<wrt, T>(x, y, z);
    const T fx(fx_), fy(fy_);
    p.pixel = {fx * m.x + T(cx_), fy * m.y + T(cy_)};
    if constexpr (includes(wrt, Wrt::point))
      scale_rows<0>(m.by_point, p.point_jacobian, std::make_integer_sequence<int, 3>{});
    if constexpr (includes(wrt, Wrt::parameters)) {
      constexpr int before = Body::leading, behind = Body::count - before;
      auto& J = p.parameter_jacobian;
      set_column<before>(J, m.x, T(0));
      set_column<before + 1>(J, T(0), m.y);
      set_column<before + 2>(J, T(1), T(0));
      set_column<before + 3>(J, T(0), T(1));
      if constexpr (before > 0) scale_rows<0>(m.by_parameters, J, std::make_integer_sequence<int, before>{});
      if constexpr (behind > 0) scale_rows<4, before>(m.by_parameters, J, std::make_integer_sequence<int, behind>{});
    }
    return both<T>(m.valid, finite_lanes<T>(p.pixel.x() + p.pixel.y()));
  }

  // The columns from First on are multiplied by the focal lengths and stored Shift columns further right. Constant
  // indices keep matrices in registers.
  template <int Shift, int First = 0, int... Column>
  SPLINERTIA_ALWAYS_INLINE inline void scale_rows(const auto& from, auto& to,
                                                  std::integer_sequence<int, Column...>) const {
    using T = std::remove_cvref_t<decltype(to(0, 0))>;
    const T fx(fx_), fy(fy_);
    (set_column<Shift + First + Column>(to, T(fx * from(0, First + Column)), T(fy * from(1, First + Column))), ...);
  }
  template <int Column, typename T>
  SPLINERTIA_ALWAYS_INLINE static inline void set_column(auto& matrix, const T& u, const T& v) {
    matrix(0, Column) = u;
    matrix(1, Column) = v;
  }

  Scalar fx_, fy_, cx_, cy_;
  Body body_;
};

}  // namespace splinertia::detail
