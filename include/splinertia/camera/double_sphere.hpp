// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <splinertia/camera/detail/blended_projection.hpp>
#include <splinertia/camera/detail/focal_model.hpp>
#include <splinertia/camera/detail/shifted_sphere.hpp>
#include <splinertia/camera/detail/symmetric_ray.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia {

namespace detail {

/// m = (x, y) / (α d₂ + (1 − α) t), where t = z + ξ d and d₂ = |(x, y, t)|.
template <typename ScalarType>
class DoubleSphereBody {
 public:
  using Scalar = ScalarType;
  static constexpr int count = 2, leading = 0;
  static constexpr bool needs_scale = true;

  DoubleSphereBody(const Scalar& xi, const Scalar& alpha) : xi_(xi), alpha_(alpha) {
    require_shift("DoubleSphere", xi);
    require_blend("DoubleSphere", alpha);
    first_border_ = shifted_border(xi);
    second_border_ = blend_border(alpha);
  }

  [[nodiscard]] Eigen::Vector2<Scalar> parameters() const { return {xi_, alpha_}; }
  [[nodiscard]] static DoubleSphereBody from(const Eigen::Vector2<Scalar>& p) { return {p[0], p[1]}; }
  [[nodiscard]] Scalar largest_angle() const {
    using std::acos;
    return unshift_angle(Scalar(acos(-second_border_)), xi_);
  }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline PlanePoint<T, count, wrt> map(const T& x, const T& y,
                                                                              const T& z) const {
    const T xi(xi_), alpha(alpha_), square = x * x + y * y, d = square_root<T>(square + z * z);
    const BlendedLength<T> shifted(xi, T(1), square, z, d);
    const T t = shifted.value, d2 = square_root<T>(square + t * t);
    const BlendedLength<T> blended(alpha, T(1) - alpha, square, t, d2);
    const T denominator = blended.value, scale = T(1) / denominator;
    PlanePoint<T, count, wrt> m;
    m.x = x * scale;
    m.y = y * scale;
    const Mask<T> first = less<T>(-(T(first_border_) * d), z), second = less<T>(-(T(second_border_) * d2), t);
    m.valid = both<T>(both<T>(first, second), less<T>(T(0), denominator));
    if constexpr (includes(wrt, Wrt::point)) {
      // The denominator's derivatives: α/d₂ for x and y through d₂, by_t through t.
      const T by_t = blended.slope, c = alpha / d2 + by_t * (xi / d);
      set_quotient_jacobian<T>(m, x, y, scale, c, by_t * shifted.slope);
    }
    if constexpr (includes(wrt, Wrt::parameters)) {
      set_quotient_parameters<T>(m, scale, d * blended.slope, difference_of_length<T>(square, t, d2));
    }
    return m;
  }

  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unmap(const Scalar& x, const Scalar& y) const {
    const auto shifted = unblend<Scalar>(x, y, alpha_, Scalar(1));
    if (!shifted) return std::nullopt;
    return unshift_sphere<Scalar>(shifted->x(), shifted->y(), shifted->z(), xi_);
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 3, 2> ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                         const Scalar& y) const {
    const Scalar one(1), square = ray.x() * ray.x() + ray.y() * ray.y(), t = ray.z() + xi_;
    const Scalar slope = (one + xi_ * ray.z()) * blend_slope<Scalar>(alpha_, square, t);
    return symmetric_ray_jacobian<Scalar>(ray, x, y, one + xi_, slope);
  }

 private:
  Scalar xi_, alpha_, first_border_, second_border_;
};

}  // namespace detail

/// The double sphere model (Usenko, Demmel, Cremers, "The double sphere camera model", 3DV 2018). A point is projected to
/// a sphere, from there to a second one shifted by ξ, and from a centre that α places to the image plane:
///   m = (x, y) / (α d₂ + (1 − α) t), t = z + ξ d, d = |(x, y, z)|, d₂ = |(x, y, t)|
/// Parameters: fx, fy, cx, cy in pixels, ξ, α.
///
/// Its domain is t > −w d₂, w = α/(1 − α) up to α = 1/2 and (1 − α)/α beyond. That is the image of the inverse. With
/// ξ > 1 it is z > −d/ξ.
template <typename ScalarType>
class DoubleSphere
    : public detail::FocalModel<DoubleSphere<ScalarType>, detail::DoubleSphereBody<ScalarType>, ScalarType> {
  using Body = detail::DoubleSphereBody<ScalarType>;
  using Base = detail::FocalModel<DoubleSphere, Body, ScalarType>;

 public:
  using Scalar = ScalarType;
  static constexpr const char* name = "ds-none";

  /// Throws std::invalid_argument unless all numbers are finite, fx and fy positive, ξ > −1 and α in [0, 1].
  DoubleSphere(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Scalar& xi,
               const Scalar& alpha)
      : DoubleSphere(fx, fy, cx, cy, Body(xi, alpha)) {}

 private:
  friend Base;
  DoubleSphere(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Body& body)
      : Base("DoubleSphere", fx, fy, cx, cy, body) {}
};

}  // namespace splinertia
