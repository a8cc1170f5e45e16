// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <splinertia/camera/detail/plane_distortion.hpp>

namespace splinertia {

/// A perfect lens.
template <typename ScalarType>
struct NoDistortion {
  using Scalar = ScalarType;
  static constexpr int count = 0;
  static constexpr const char* name = "none";

  [[nodiscard]] Eigen::Matrix<Scalar, 0, 1> parameters() const { return {}; }
  [[nodiscard]] static NoDistortion from(const Eigen::Matrix<Scalar, 0, 1>&) { return {}; }

  /// The radius |m| at which the domain ends: nowhere.
  [[nodiscard]] Scalar limit() const { return (std::numeric_limits<Scalar>::max)(); }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline detail::Distorted<T, count, wrt> distort(const T& x, const T& y) const {
    detail::Distorted<T, count, wrt> m;
    m.x = x;
    m.y = y;
    m.valid = detail::less<T>(T(0), T(1));
    if constexpr (includes(wrt, Wrt::point)) m.by_point << T(1), T(0), T(0), T(1);
    return m;
  }
  [[nodiscard]] std::optional<Eigen::Vector2<Scalar>> undistort(const Scalar& x, const Scalar& y) const {
    return Eigen::Vector2<Scalar>(x, y);
  }
};

}  // namespace splinertia
