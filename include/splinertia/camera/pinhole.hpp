// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <optional>
#include <splinertia/camera/detail/focal_model.hpp>
#include <splinertia/camera/detail/model_name.hpp>
#include <splinertia/camera/detail/plane_distortion.hpp>
#include <splinertia/camera/detail/symmetric_ray.hpp>
#include <splinertia/camera/distortion/equidistant.hpp>
#include <splinertia/camera/distortion/no_distortion.hpp>
#include <splinertia/camera/distortion/radial_tangential.hpp>
#include <splinertia/camera/distortion/rational.hpp>

namespace splinertia {

namespace detail {

/// The perspective image (x/z, y/z), distorted. Points behind the camera are outside the domain.
template <typename Distortion>
struct PerspectiveBody {
  using Scalar = typename Distortion::Scalar;
  static constexpr int count = Distortion::count, leading = 0;

  Distortion distortion;

  [[nodiscard]] Eigen::Matrix<Scalar, count, 1> parameters() const { return distortion.parameters(); }
  [[nodiscard]] static PerspectiveBody from(const Eigen::Matrix<Scalar, count, 1>& p) { return {Distortion::from(p)}; }

  [[nodiscard]] Scalar largest_angle() const {
    using std::atan;
    return atan(distortion.limit());
  }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline PlanePoint<T, count, wrt> map(const T& x, const T& y,
                                                                              const T& z) const {
    const T u = x / z, v = y / z;
    const auto d = distortion.template distort<wrt, T>(u, v);
    PlanePoint<T, count, wrt> m;
    m.x = d.x;
    m.y = d.y;
    m.valid = both(d.valid, less<T>(T(0), z));
    if constexpr (includes(wrt, Wrt::point)) {
      const Eigen::Matrix2<T> D = d.by_point * (T(1) / z);
      m.by_point << D(0, 0), D(0, 1), -(D(0, 0) * u + D(0, 1) * v), D(1, 0), D(1, 1), -(D(1, 0) * u + D(1, 1) * v);
    }
    if constexpr (includes(wrt, Wrt::parameters) && count > 0) m.by_parameters = d.by_parameters;
    return m;
  }

  [[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unmap(const Scalar& x, const Scalar& y) const {
    const auto m = distortion.undistort(x, y);
    if (!m) return std::nullopt;
    return Eigen::Vector3<Scalar>(m->x(), m->y(), Scalar(1));
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 3, 2> ray_jacobian(const Eigen::Vector3<Scalar>& ray, const Scalar& x,
                                                         const Scalar& y) const {
    const Scalar& z = ray.z();
    if constexpr (count == 0) {
      return ray_jacobian_from_slopes<Scalar>(ray, x, y, z * z, z);
    } else {
      const Scalar u = ray.x() / z, v = ray.y() / z;
      return ray_jacobian_from_slopes<Scalar>(ray, u, v, z * z, z) * undistorted_jacobian<Scalar>(distortion, u, v);
    }
  }
};

template <typename Distortion>
struct PinholeBody {
  using type = PerspectiveBody<Distortion>;
  static type make(const Distortion& d) { return {d}; }
};
/// This lens acts on the angle from the axis, and so also on points behind the camera.
template <typename Scalar>
struct PinholeBody<Equidistant<Scalar>> {
  using type = Equidistant<Scalar>;
  static type make(const type& d) { return d; }
};

}  // namespace detail

/// A pinhole camera with a lens that distorts: NoDistortion, RadialTangential, Rational or Equidistant. Parameters: fx,
/// fy, cx, cy in pixels, and those of the distortion.
template <typename Distortion>
class Pinhole : public detail::FocalModel<Pinhole<Distortion>, typename detail::PinholeBody<Distortion>::type,
                                          typename Distortion::Scalar> {
  using Body = typename detail::PinholeBody<Distortion>::type;
  using Base = detail::FocalModel<Pinhole, Body, typename Distortion::Scalar>;

 public:
  using Scalar = typename Distortion::Scalar;
  static constexpr const char* name = detail::model_name<"pinhole-", Distortion>.data();

  /// Throws std::invalid_argument unless all numbers are finite and fx and fy positive.
  Pinhole(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const Distortion& distortion)
      : Base("Pinhole", fx, fy, cx, cy, detail::PinholeBody<Distortion>::make(distortion)) {}

 private:
  friend Base;
  template <std::same_as<Body> B>  // no candidate for {}
  Pinhole(const Scalar& fx, const Scalar& fy, const Scalar& cx, const Scalar& cy, const B& body)
    requires(!std::same_as<Body, Distortion>)
      : Base("Pinhole", fx, fy, cx, cy, body) {}
};

}  // namespace splinertia
