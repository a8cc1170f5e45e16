// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <splinertia/camera/detail/first_root.hpp>
#include <splinertia/camera/detail/plane_distortion.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia {

/// Radial distortion by a quotient of polynomials, and tangential distortion, as OpenCV's rational model defines them.
/// The radial factor is N/D = (1 + k₁ s + k₂ s² + k₃ s³) / (1 + k₄ s + k₅ s² + k₆ s³), s = |m|²; the tangential terms are
/// those of RadialTangential. Parameters: k₁ k₂ p₁ p₂ k₃ k₄ k₅ k₆.
///
/// Its domain is |m| < r₀, where r N/D stops increasing or D is zero.
template <typename ScalarType>
class Rational {
 public:
  using Scalar = ScalarType;
  static constexpr int count = 8;
  static constexpr const char* name = "radtan8";

  /// Throws std::invalid_argument unless all numbers are finite.
  Rational(const Scalar& k1, const Scalar& k2, const Scalar& p1, const Scalar& p2, const Scalar& k3, const Scalar& k4,
           const Scalar& k5, const Scalar& k6)
      : n_{Scalar(1), k1, k2, k3}, d_{Scalar(1), k4, k5, k6}, p1_(p1), p2_(p2) {
    detail::require_all_finite("Rational", "coefficients", parameters());
    std::array<Scalar, 7> slope;  // numerator of d(rN/D)/dr
    slope.fill(Scalar(0));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        slope[i + j] += Scalar(1 + 2 * (static_cast<int>(i) - static_cast<int>(j))) * n_[i] * d_[j];
      }
    }
    const Scalar most = detail::largest_factor<Scalar>(), none = (std::numeric_limits<Scalar>::max)();
    const auto turn = detail::first_root(slope, most), pole = detail::first_root(d_, most);
    most_square_ = (std::min)(turn.value_or(none), pole.value_or(none));
    limit_ = most_square_ < none ? detail::square_root(most_square_) : none;
    Scalar unused;
    end_ = most_square_ < pole.value_or(none) ? radial(limit_, unused) : none;
  }

  [[nodiscard]] Eigen::Matrix<Scalar, 8, 1> parameters() const {
    Eigen::Matrix<Scalar, 8, 1> p;
    p << n_[1], n_[2], p1_, p2_, n_[3], d_[1], d_[2], d_[3];
    return p;
  }
  [[nodiscard]] static Rational from(const Eigen::Matrix<Scalar, 8, 1>& p) {
    return {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]};
  }

  /// The radius |m| at which the domain ends.
  [[nodiscard]] const Scalar& limit() const { return limit_; }

  template <Wrt wrt, typename T>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline detail::Distorted<T, count, wrt> distort(const T& x, const T& y) const {
    const T s = x * x + y * y;
    const T n1(n_[1]), n2(n_[2]), n3(n_[3]), d1(d_[1]), d2(d_[2]), d3(d_[3]);
    const T one_over_d = T(1) / (T(1) + s * (d1 + s * (d2 + s * d3)));
    const T g = (T(1) + s * (n1 + s * (n2 + s * n3))) * one_over_d;
    const T n_slope = n1 + s * ((n2 + n2) + s * (T(3) * n3)), d_slope = d1 + s * ((d2 + d2) + s * (T(3) * d3));
    auto m = detail::distort_brown<wrt, count, T>(x, y, g, (n_slope - g * d_slope) * one_over_d, T(p1_), T(p2_));
    m.valid = detail::less<T>(s, T(most_square_));
    if constexpr (includes(wrt, Wrt::parameters)) {
      T power = s * one_over_d;
      for (int i = 0; i < 3; ++i, power = power * s) {
        const int by_numerator = i < 2 ? i : 4;
        m.by_parameters.col(by_numerator) << x * power, y * power;
        m.by_parameters.col(5 + i) << -(x * power * g), -(y * power * g);
      }
    }
    return m;
  }

  /// Nothing also where powers overflow: 2e6 focal lengths from the centre for float, 1e51 for double.
  [[nodiscard]] std::optional<Eigen::Vector2<Scalar>> undistort(const Scalar& x, const Scalar& y) const {
    if (!(x * x + y * y < detail::largest_factor<Scalar>())) return std::nullopt;
    const auto radius = [this](const Scalar& r, Scalar& slope) { return radial(r, slope); };
    return detail::undistort_brown<Scalar>(*this, radius, x, y, limit_, end_,
                                           Scalar(detail::magnitude(p1_) + detail::magnitude(p2_)));
  }

 private:
  [[nodiscard]] Scalar radial(const Scalar& r, Scalar& slope) const {
    const Scalar s = r * r, d = detail::polynomial_at(d_, s), g = detail::polynomial_at(n_, s) / d;
    const Scalar n_slope = n_[1] + s * (Scalar(2) * n_[2] + s * Scalar(3) * n_[3]);
    const Scalar d_slope = d_[1] + s * (Scalar(2) * d_[2] + s * Scalar(3) * d_[3]);
    slope = g + Scalar(2) * s * (n_slope - g * d_slope) / d;
    return r * g;
  }

  std::array<Scalar, 4> n_, d_;  // polynomials in s
  Scalar p1_, p2_;
  Scalar most_square_, limit_, end_;
};

template <typename Scalar>
Rational(Scalar, Scalar, Scalar, Scalar, Scalar, Scalar, Scalar, Scalar) -> Rational<Scalar>;

}  // namespace splinertia
