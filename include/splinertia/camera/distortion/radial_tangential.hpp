// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <splinertia/camera/detail/first_root.hpp>
#include <splinertia/camera/detail/plane_distortion.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia {

/// Radial distortion of two coefficients and tangential distortion (Brown, "Decentering distortion of lenses", 1966),
/// as OpenCV and Kalibr (`radtan`) define it. Its domain is |m| < r₀, where r (1 + k₁ r² + k₂ r⁴) stops increasing.
template <typename ScalarType>
class RadialTangential {
 public:
  using Scalar = ScalarType;
  static constexpr int count = 4;
  static constexpr const char* name = "radtan";

  RadialTangential(const Scalar& k1, const Scalar& k2, const Scalar& p1, const Scalar& p2)
      : k1_(k1), k2_(k2), p1_(p1), p2_(p2) {
    detail::require_all_finite("RadialTangential", "coefficients", parameters());
    const std::array<Scalar, 3> slope{Scalar(1), Scalar(3) * k1, Scalar(5) * k2};
    const auto root = detail::first_root(slope, (std::numeric_limits<Scalar>::max)());
    most_square_ = root ? *root : (std::numeric_limits<Scalar>::max)();
    limit_ = root ? detail::square_root(most_square_) : most_square_;
    Scalar unused;
    end_ = root ? radial(limit_, unused) : (std::numeric_limits<Scalar>::max)();
  }

  [[nodiscard]] Eigen::Vector4<Scalar> parameters() const { return {k1_, k2_, p1_, p2_}; }
  [[nodiscard]] static RadialTangential from(const Eigen::Vector4<Scalar>& p) { return {p[0], p[1], p[2], p[3]}; }

  /// The radius |m| at which the domain ends.
  [[nodiscard]] const Scalar& limit() const { return limit_; }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline detail::Distorted<T, count, wrt> distort(const T& x, const T& y) const {
    const T s = x * x + y * y, k1(k1_), k2(k2_);
    auto m = detail::distort_brown<wrt, count, T>(x, y, T(1) + s * (k1 + s * k2), k1 + (k2 + k2) * s, T(p1_), T(p2_));
    m.valid = detail::less<T>(s, T(most_square_));
    if constexpr (includes(wrt, Wrt::parameters)) {
      const T xs = x * s, ys = y * s;
      m.by_parameters(0, 0) = xs;
      m.by_parameters(1, 0) = ys;
      m.by_parameters(0, 1) = xs * s;
      m.by_parameters(1, 1) = ys * s;
    }
    return m;
  }

  [[nodiscard]] std::optional<Eigen::Vector2<Scalar>> undistort(const Scalar& x, const Scalar& y) const {
    const auto radius = [this](const Scalar& r, Scalar& slope) { return radial(r, slope); };
    return detail::undistort_brown<Scalar>(*this, radius, x, y, limit_, end_,
                                           Scalar(detail::magnitude(p1_) + detail::magnitude(p2_)));
  }

 private:
  [[nodiscard]] Scalar radial(const Scalar& r, Scalar& slope) const {
    const Scalar s = r * r;
    slope = Scalar(1) + s * (Scalar(3) * k1_ + s * Scalar(5) * k2_);
    return r * (Scalar(1) + s * (k1_ + s * k2_));
  }

  Scalar k1_, k2_, p1_, p2_;
  Scalar most_square_, limit_, end_;
};

template <typename Scalar>
RadialTangential(Scalar, Scalar, Scalar, Scalar) -> RadialTangential<Scalar>;

}  // namespace splinertia
