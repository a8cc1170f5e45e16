// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <splinertia/camera/detail/blended_projection.hpp>
#include <splinertia/camera/detail/focal_model.hpp>
#include <splinertia/camera/detail/symmetric_ray.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia {

namespace detail {

/// m = (x, y) / (α ρ + (1 − α) z), where ρ = sqrt(β (x² + y²) + z²).
template <typename ScalarType>
class ExtendedUnifiedBody {
 public:
  using Scalar = ScalarType;
  static constexpr int count = 2, leading = 0;
  static constexpr bool needs_scale = true;

  ExtendedUnifiedBody(const Scalar& alpha, const Scalar& beta) : alpha_(alpha), beta_(beta) {
    require_blend("ExtendedUnified", alpha);
    require_factor("ExtendedUnified", "beta", beta);
    require_positive("ExtendedUnified", "beta", beta);
    border_ = blend_border(alpha);
  }

  [[nodiscard]] Eigen::Vector2<Scalar> parameters() const { return {alpha_, beta_}; }
  [[nodiscard]] static ExtendedUnifiedBody from(const Eigen::Vector2<Scalar>& p) { return {p[0], p[1]}; }
  [[nodiscard]] Scalar largest_angle() const {
    using std::atan2;
    return atan2(square_root<Scalar>((Scalar(1) - border_) * (Scalar(1) + border_)), -(square_root(beta_) * border_));
  }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline PlanePoint<T, count, wrt> map(const T& x, const T& y,
                                                                              const T& z) const {
    const T alpha(alpha_), beta(beta_), square = x * x + y * y, rho = square_root<T>(beta * square + z * z);
    const BlendedLength<T> blended(alpha, T(1) - alpha, beta * square, z, rho);
    const T denominator = blended.value, scale = T(1) / denominator;
    PlanePoint<T, count, wrt> m;
    m.x = x * scale;
    m.y = y * scale;
    m.valid = both<T>(less<T>(-(T(border_) * rho), z), less<T>(T(0), denominator));
    if constexpr (includes(wrt, Wrt::point)) {
      set_quotient_jacobian<T>(m, x, y, scale, alpha / rho * beta, blended.slope);
    }
    if constexpr (includes(wrt, Wrt::parameters)) {
      const T by_beta = T(Scalar(0.5)) * alpha * square / rho;
      set_quotient_parameters<T>(m, scale, difference_of_length<T>(beta * square, z, rho), by_beta);
    }
    return m;
  }

  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unmap(const Scalar& x, const Scalar& y) const {
    return unblend<Scalar>(x, y, alpha_, beta_);
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 3, 2> ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                         const Scalar& y) const {
    const Scalar square = ray.x() * ray.x() + ray.y() * ray.y();
    return symmetric_ray_jacobian<Scalar>(ray, x, y, Scalar(1), blend_slope<Scalar>(alpha_, beta_ * square, ray.z()));
  }

 private:
  Scalar alpha_, beta_, border_;
};

}  // namespace detail

/// The extended unified model (Khomutenko, Garcia, Martinet, "An enhanced unified camera model", RA-L 2016): the unified
/// model on an ellipsoid instead of a sphere.
///   m = (x, y) / (α ρ + (1 − α) z), ρ = sqrt(β (x² + y²) + z²)
/// Parameters: fx, fy, cx, cy in pixels, α, β. Its domain is z > −w ρ, w = α/(1 − α) up to α = 1/2 and (1 − α)/α beyond.
template <typename ScalarType>
class ExtendedUnified
    : public detail::FocalModel<ExtendedUnified<ScalarType>, detail::ExtendedUnifiedBody<ScalarType>, ScalarType> {
  using Body = detail::ExtendedUnifiedBody<ScalarType>;
  using Base = detail::FocalModel<ExtendedUnified, Body, ScalarType>;

 public:
  using Scalar = ScalarType;
  static constexpr const char* name = "eucm-none";

  /// Throws std::invalid_argument unless all numbers are finite, fx, fy and β positive and α in [0, 1].
  ExtendedUnified(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Scalar& alpha,
                  const Scalar& beta)
      : ExtendedUnified(fx, fy, cx, cy, Body(alpha, beta)) {}

 private:
  friend Base;
  ExtendedUnified(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Body& body)
      : Base("ExtendedUnified", fx, fy, cx, cy, body) {}
};

}  // namespace splinertia
