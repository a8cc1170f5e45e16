// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/camera/detail/polar_angle.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/detail/select.hpp>

namespace splinertia {

/// A panorama of all directions in longitude and latitude:
///   u = width (λ/2π + 1/2), λ = atan2(x, z);   v = height (φ/π + 1/2), φ = atan2(y, |(x, z)|)
/// Forward is the centre of the image. Parameters: width, height in pixels.
///
/// Its domain is all but the y axis. A ray exists for 0 ≤ u ≤ width, 0 ≤ v ≤ height, with the rows of the two poles.
template <typename ScalarType>
class Equirectangular {
 public:
  using Scalar = ScalarType;
  static constexpr const char* name = "equirectangular";
  static constexpr int parameter_count = 2;
  using Parameters = Eigen::Matrix<Scalar, 2, 1>;

  /// Throws std::invalid_argument unless both numbers are finite and positive.
  Equirectangular(const Scalar& width, const Scalar& height) : width_(width), height_(height) {
    detail::require_positive("Equirectangular", "width", width);
    detail::require_positive("Equirectangular", "height", height);
  }

  [[nodiscard]] const Scalar& width() const { return width_; }
  [[nodiscard]] const Scalar& height() const { return height_; }
  [[nodiscard]] Parameters parameters() const { return {width_, height_}; }
  /// Throws std::invalid_argument as the constructor does.
  [[nodiscard]] static Equirectangular from_parameters(const Parameters& p) { return {p[0], p[1]}; }

  /// The pixel of a point, or nothing outside the domain.
  [[nodiscard]] std::optional<Eigen::Vector2<Scalar>> project(const Eigen::Vector3<Scalar>& point) const {
    detail::Mask<Scalar> valid;
    const auto p = project_lanes<Wrt::nothing>(point.x(), point.y(), point.z(), valid);
    if (!valid) return std::nullopt;
    return p.pixel;
  }

  /// The pixel of a point with its Jacobians, or nothing outside the domain.
  template <Wrt wrt>
  [[nodiscard]] std::optional<Projection<Scalar, parameter_count, wrt>> linearize(
      const Eigen::Vector3<Scalar>& point) const {
    detail::Mask<Scalar> valid;
    const auto p = project_lanes<wrt>(point.x(), point.y(), point.z(), valid);
    if (!valid) return std::nullopt;
    return p;
  }

  /// The ray, of length 1, of the points that have this pixel. Nothing outside the image.
  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unproject(const Eigen::Vector2<Scalar>& pixel) const {
    const auto ray = linearize_ray(pixel);
    if (!ray) return std::nullopt;
    return ray->direction;
  }

  /// The ray with its Jacobian with respect to the pixel.
  [[nodiscard]] std::optional<Ray<Scalar>> linearize_ray(const Eigen::Vector2<Scalar>& pixel) const {
    using std::cos, std::sin;
    const Scalar &u = pixel.x(), &v = pixel.y();
    if (!(Scalar(0) <= u && u <= width_ && Scalar(0) <= v && v <= height_)) return std::nullopt;
    if (!detail::is_finite(u) || !detail::is_finite(v)) return std::nullopt;
    const Scalar pi = detail::pi_of<Scalar>(), half(0.5);
    const Scalar longitude = Scalar(2) * pi * ((u - half * width_) / width_);
    const Scalar latitude = pi * ((v - half * height_) / height_);
    const Scalar sx = sin(longitude), cx = cos(longitude), sy = sin(latitude), cy = cos(latitude);
    Ray<Scalar> ray;
    ray.direction << cy * sx, sy, cy * cx;
    ray.pixel_jacobian << cy * cx, -(sy * sx), Scalar(0), cy, -(cy * sx), -(sy * cx);
    ray.pixel_jacobian.col(0) *= Scalar(2) * pi / width_;
    ray.pixel_jacobian.col(1) *= pi / height_;
    return ray;
  }

  /// The projection of a point or of a SIMD pack of points, and which are in the domain.
  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Projection<T, parameter_count, wrt> project_lanes(
      const T& x, const T& y, const T& z, detail::Mask<T>& valid) const {
    using namespace detail;
    // The horizontal part has a scale of its own: close to a pole it is lost beside y.
    const T level = direction_scale<T>(x, T(0), z), lx = x * level, lz = z * level;
    const T scale = direction_scale<T>(x, y, z), sx = x * scale, sy = y * scale, sz = z * scale;
    const T horizontal = square_root<T>(sx * sx + sz * sz);
    // Angles from behind and from above are accurate at the border of the image, where the pixel is 0.
    const T turn(Scalar(1) / (Scalar(2) * pi_of<Scalar>()));
    const T behind = polar_angle<T>(magnitude(lx), -lz) * turn;
    const T across = select<T>(less<T>(x, T(0)), behind, T(1) - behind);
    const T down = polar_angle<T>(horizontal, -sy) * (turn + turn);
    Projection<T, parameter_count, wrt> p;
    p.pixel = {T(width_) * across, T(height_) * down};
    const T level_distance = magnitude(x) + magnitude(z);
    valid = both(less<T>(T(0), level_distance), finite_lanes<T>(sx + sy + sz));
    if constexpr (includes(wrt, Wrt::point)) {
      const T square = lx * lx + lz * lz, radius = square_root<T>(square), ex = lx / radius, ez = lz / radius;
      const T by_longitude = T(width_) * turn * level / square;
      const T by_latitude = T(height_) * (turn + turn) * scale / (horizontal * horizontal + sy * sy);
      p.point_jacobian << lz * by_longitude, T(0), -(lx * by_longitude),  //
          -(ex * sy * by_latitude), horizontal * by_latitude, -(ez * sy * by_latitude);
    }
    if constexpr (includes(wrt, Wrt::parameters)) p.parameter_jacobian << across, T(0), T(0), down;
    return p;
  }

 private:
  Scalar width_, height_;
};

}  // namespace splinertia
