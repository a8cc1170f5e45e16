// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/camera/detail/focal_model.hpp>
#include <splinertia/camera/detail/polar_angle.hpp>
#include <splinertia/camera/detail/symmetric_ray.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/detail/square_root.hpp>
#include <splinertia/group/detail/stumpff.hpp>

namespace splinertia {

namespace detail {

/// m = (x, y) a/(w r), where r = |(x, y)|, a = atan(2 tan(w/2) r/z).
template <typename ScalarType>
class FieldOfViewBody {
 public:
  using Scalar = ScalarType;
  static constexpr int count = 1, leading = 0;
  static constexpr bool needs_scale = true;

  explicit FieldOfViewBody(const Scalar& w) : w_(w) {
    require(is_finite(w) && w >= Scalar(0) && w < pi_of<Scalar>(), "FieldOfView", "w", w, "a number in [0, pi)");
    using std::sin, std::tan;
    tangent_ = Scalar(2) * tan(w / Scalar(2));
    const bool pinhole = w < (std::numeric_limits<Scalar>::min)();
    ratio_ = pinhole ? Scalar(1) : Scalar(tangent_ / w);
    one_over_w_ = pinhole ? Scalar(0) : Scalar(1) / w;
    one_over_sine_ = pinhole ? Scalar(0) : Scalar(Scalar(1) / sin(w));
    defect_ = stumpff<3>(Scalar(w * w)).full[3];
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 1, 1> parameters() const { return Eigen::Matrix<Scalar, 1, 1>(w_); }
  [[nodiscard]] static FieldOfViewBody from(const Eigen::Matrix<Scalar, 1, 1>& w) { return FieldOfViewBody(w[0]); }
  [[nodiscard]] Scalar largest_angle() const { return pi_of<Scalar>() / Scalar(2); }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline PlanePoint<T, count, wrt> map(const T& x, const T& y,
                                                                              const T& z) const {
    const T tangent(tangent_), ratio(ratio_), square = x * x + y * y;
    // So close to the axis, a is its tangent to rounding, and the square may underflow.
    const T reach = T(std::numeric_limits<Scalar>::epsilon()) * z;
    const Mask<T> near_axis = less<T>(tangent * tangent * square, reach * reach);
    const T r = square_root<T>(select<T>(near_axis, z * z, square));
    const T angle = select<T>(near_axis, T(0), polar_angle<T>(tangent * r, z));
    const T h = select<T>(near_axis, ratio, angle) / select<T>(near_axis, z, T(w_) * r);
    PlanePoint<T, count, wrt> m;
    m.x = h * x;
    m.y = h * y;
    m.valid = less<T>(T(0), z);
    const T by_radius = ratio / (tangent * tangent * square + z * z);  // ∂|m|/∂r is z times this
    if constexpr (includes(wrt, Wrt::point)) {
      // The derivative of m along (x, y) is that of the radius, across it is h.
      const T more = by_radius * z - h;
      const T ex = select<T>(near_axis, T(0), x / r), ey = select<T>(near_axis, T(0), y / r), across = more * ex * ey;
      m.by_point(0, 0) = h + more * ex * ex;
      m.by_point(0, 1) = across;
      m.by_point(0, 2) = -(by_radius * x);
      m.by_point(1, 0) = across;
      m.by_point(1, 1) = h + more * ey * ey;
      m.by_point(1, 2) = -(by_radius * y);
    }
    if constexpr (includes(wrt, Wrt::parameters)) {
      // ∂h/∂w, h = a/(w r), is (sin 2a / sin w − 2a/w) / (2 w r). For small 2a both terms are close to each other, and
      // their differences from 2a / sin w are subtracted instead.
      const T twice = angle + angle, small = twice * twice, w(w_), one_over_sine(one_over_sine_);
      const T series = w * w * one_over_sine * h * (T(defect_) - T(4) * h * h * square * stumpff_series<3, T>(small));
      const T by_w = select<T>(less<T>(small, T(2)), series, by_radius * z * one_over_sine - h * T(one_over_w_));
      m.by_parameters(0, 0) = x * by_w;
      m.by_parameters(1, 0) = y * by_w;
    }
    return m;
  }

  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unmap(const Scalar& x, const Scalar& y) const {
    using std::cos, std::sin;
    const Scalar one = direction_scale<Scalar>(x, y, Scalar(1)), a = x * one, b = y * one;
    const Scalar square = a * a + b * b;
    if (square < smallest_square<Scalar>()) return Eigen::Vector3<Scalar>(x, y, ratio_);
    const Scalar angle = w_ * (square_root(square) / one);
    if (!(angle < pi_of<Scalar>() / Scalar(2))) return std::nullopt;
    if (angle < std::numeric_limits<Scalar>::epsilon()) return Eigen::Vector3<Scalar>(a, b, ratio_ * one);
    const Scalar share = sin(angle) / angle;
    return Eigen::Vector3<Scalar>(share * a, share * b, cos(angle) * ratio_ * one);
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 3, 2> ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                         const Scalar& y) const {
    const Scalar square = ray.x() * ray.x() + ray.y() * ray.y();
    const Scalar along = (ray.z() * ray.z() + tangent_ * tangent_ * square) / ratio_;
    return ray_jacobian_from_slopes<Scalar>(ray, x, y, along, sine_by_radius<Scalar>(ray, x, y, Scalar(1) / ratio_));
  }

 private:
  Scalar w_, tangent_, ratio_;                  // 2 tan(w/2), and that divided by w
  Scalar one_over_w_, one_over_sine_, defect_;  // 0, 0 for w = 0; c₃(w²) = (w − sin w)/w³
};

}  // namespace detail

/// The field-of-view model (Devernay, Faugeras, "Straight lines have to be straight", 2001): a point at the angle θ from
/// the optical axis appears at the radius atan(2 tan(w/2) tan θ)/w, (0, 0) at its centre. w = 0 is the pinhole camera,
/// the limit. Parameters: fx, fy, cx, cy in pixels, w in rad. Its domain is z > 0.
template <typename ScalarType>
class FieldOfView
    : public detail::FocalModel<FieldOfView<ScalarType>, detail::FieldOfViewBody<ScalarType>, ScalarType> {
  using Body = detail::FieldOfViewBody<ScalarType>;
  using Base = detail::FocalModel<FieldOfView, Body, ScalarType>;

 public:
  using Scalar = ScalarType;
  static constexpr const char* name = "fov";

  /// Throws std::invalid_argument unless all numbers are finite, fx and fy positive and w in [0, π).
  FieldOfView(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Scalar& w)
      : FieldOfView(fx, fy, cx, cy, Body(w)) {}

 private:
  friend Base;
  FieldOfView(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Body& body)
      : Base("FieldOfView", fx, fy, cx, cy, body) {}
};

}  // namespace splinertia
