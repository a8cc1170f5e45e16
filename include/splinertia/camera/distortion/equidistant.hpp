// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <splinertia/camera/detail/first_root.hpp>
#include <splinertia/camera/detail/focal_model.hpp>
#include <splinertia/camera/detail/increasing_inverse.hpp>
#include <splinertia/camera/detail/polar_angle.hpp>
#include <splinertia/camera/detail/symmetric_ray.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/require.hpp>

namespace splinertia {

/// The fisheye lens of Kannala and Brandt ("A generic camera model and calibration method", PAMI 2006), as OpenCV
/// (`fisheye`) and Kalibr (`equi`) define it: a point at the angle θ from the optical axis appears at the radius
/// θ (1 + k₁ θ² + k₂ θ⁴ + k₃ θ⁶ + k₄ θ⁸). Its domain is θ < θ₀, where the radius stops increasing, or θ < π. It
/// includes points behind the camera.
template <typename ScalarType>
class Equidistant {
 public:
  using Scalar = ScalarType;
  static constexpr int count = 4, leading = 0;
  static constexpr const char* name = "equi";

  Equidistant(const Scalar& k1, const Scalar& k2, const Scalar& k3, const Scalar& k4) : k_{k1, k2, k3, k4} {
    detail::require_all_finite("Equidistant", "coefficients", parameters());
    const Scalar pi = detail::pi_of<Scalar>();
    const std::array<Scalar, 5> slope{Scalar(1), Scalar(3) * k1, Scalar(5) * k2, Scalar(7) * k3, Scalar(9) * k4};
    const auto root = detail::first_root(slope, Scalar(pi * pi));
    limit_ = root ? detail::square_root(*root) : pi;
    Scalar unused;
    end_ = radius(limit_, unused);
  }

  [[nodiscard]] Eigen::Vector4<Scalar> parameters() const { return {k_[0], k_[1], k_[2], k_[3]}; }
  [[nodiscard]] static Equidistant from(const Eigen::Vector4<Scalar>& k) { return {k[0], k[1], k[2], k[3]}; }

  /// The angle from the optical axis at which the domain ends, rad.
  [[nodiscard]] const Scalar& largest_angle() const { return limit_; }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline detail::PlanePoint<T, count, wrt> map(const T& x, const T& y,
                                                                                      const T& z) const {
    const T square = x * x + y * y;
    // So close to the axis, θ/r is 1/z to rounding, and r² may underflow.
    const T reach = T(std::numeric_limits<Scalar>::epsilon()) * z;
    const detail::Mask<T> near_axis = detail::both(detail::less<T>(square, reach * reach), detail::less<T>(T(0), z));
    const T r = detail::square_root<T>(detail::select<T>(near_axis, z * z, square)), one_over_r = T(1) / r;
    const T theta = detail::select<T>(near_axis, T(0), detail::polar_angle<T>(r, z));
    const T ratio = detail::select<T>(near_axis, one_over_r, theta * one_over_r);
    const T s = theta * theta, k1(k_[0]), k2(k_[1]), k3(k_[2]), k4(k_[3]);
    const T h = ratio * (T(1) + s * (k1 + s * (k2 + s * (k3 + s * k4))));
    detail::PlanePoint<T, count, wrt> m;
    m.x = h * x;
    m.y = h * y;
    m.valid = detail::less<T>(theta, T(limit_));
    if constexpr (includes(wrt, Wrt::point)) {
      // m = h (x, y): the derivative along (x, y) is that of the radius, across it is h.
      const T slope = T(1) + s * (T(3) * k1 + s * (T(5) * k2 + s * (T(7) * k3 + s * (T(9) * k4))));
      const T by_angle = slope / (square + z * z);
      const T ex = detail::select<T>(near_axis, T(0), x * one_over_r);
      const T ey = detail::select<T>(near_axis, T(0), y * one_over_r);
      const T more = by_angle * z - h, across = more * ex * ey;
      m.by_point << h + more * ex * ex, across, -(by_angle * x), across, h + more * ey * ey, -(by_angle * y);
    }
    if constexpr (includes(wrt, Wrt::parameters)) {
      T u = ratio * x * s, v = ratio * y * s;
      for (int i = 0; i < count; ++i, u = u * s, v = v * s) m.by_parameters.col(i) << u, v;
    }
    return m;
  }

  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unmap(const Scalar& x, const Scalar& y) const {
    const Scalar square = x * x + y * y;
    if (square < detail::smallest_square<Scalar>()) return Eigen::Vector3<Scalar>(x, y, Scalar(1));
    const Scalar r = detail::square_root(square);
    if (!(r < end_)) return std::nullopt;
    const auto f = [this](const Scalar& theta, Scalar& slope) { return radius(theta, slope); };
    const Scalar theta =
        detail::increasing_inverse<Scalar>(f, r, Scalar(0), limit_, r < limit_ ? r : Scalar(limit_ / Scalar(2)));
    using std::cos, std::sin;
    const Scalar share = sin(theta) / r;
    return Eigen::Vector3<Scalar>(share * x, share * y, cos(theta));
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 3, 2> ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                         const Scalar& y) const {
    const Scalar across = detail::sine_by_radius<Scalar>(ray, x, y, Scalar(1));
    const Scalar sine = detail::plane_norm<Scalar>(ray.x(), ray.y());
    Scalar slope;
    (void)radius(sine > Scalar(0) ? detail::polar_angle<Scalar>(sine, ray.z()) : Scalar(0), slope);
    return detail::ray_jacobian_from_slopes<Scalar>(ray, x, y, Scalar(1) / slope, across);
  }

 private:
  [[nodiscard]] Scalar radius(const Scalar& theta, Scalar& slope) const {
    const Scalar s = theta * theta;
    slope = Scalar(1) +
            s * (Scalar(3) * k_[0] + s * (Scalar(5) * k_[1] + s * (Scalar(7) * k_[2] + s * (Scalar(9) * k_[3]))));
    return theta * (Scalar(1) + s * (k_[0] + s * (k_[1] + s * (k_[2] + s * k_[3]))));
  }

  std::array<Scalar, 4> k_;
  Scalar limit_, end_;
};

template <typename Scalar>
Equidistant(Scalar, Scalar, Scalar, Scalar) -> Equidistant<Scalar>;

}  // namespace splinertia
