// SPDX-License-Identifier: MIT
/// The projection m = p / (α sqrt(β |p|² + z²) + (1 − α) z) of a point (p, z), a blend of the orthographic (α = 1) and
/// the perspective (α = 0) image. It is one-to-one where z > −w sqrt(β |p|² + z²).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <splinertia/camera/detail/direction_scale.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/require.hpp>
#include <splinertia/detail/select.hpp>
#include <splinertia/detail/square_root.hpp>

namespace splinertia::detail {

template <typename Scalar>
void require_blend(const char* whose, const Scalar& alpha) {
  require(is_finite(alpha) && alpha >= Scalar(0) && alpha <= Scalar(1), whose, "alpha", alpha, "a number in [0, 1]");
}

/// w. Up to α = 1/2 the domain ends where the denominator is zero, beyond that where |m| is largest.
template <typename Scalar>
[[nodiscard]] Scalar blend_border(const Scalar& alpha) {
  return alpha > Scalar(0.5) ? (Scalar(1) - alpha) / alpha : alpha / (Scalar(1) - alpha);
}

/// length − z for length = sqrt(square + z²), without cancellation.
template <typename T>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline T difference_of_length(const T& square, const T& z, const T& length) {
  const Mask<T> forward = less<T>(T(0), z);
  const T sum = length + select<T>(forward, z, -z);
  return select<T>(forward, square / sum, sum);
}

/// a length + b z, where length = sqrt(square + z²), and its derivative by z. Behind (z < 0) both terms nearly cancel if a
/// and b are similar. There it is a (length + z) + (b − a) z, with length + z = square / (length − z).
template <typename T>
struct BlendedLength {
  T value, slope;

  SPLINERTIA_ALWAYS_INLINE inline BlendedLength(const T& a, const T& b, const T& square, const T& z, const T& length) {
    if constexpr (is_simd_pack<T>) {
      const Mask<T> behind = less<T>(z, T(0));
      const T sum = square / (length - z);  // of use behind only
      value = select<T>(behind, a * sum + (b - a) * z, a * length + b * z);
      slope = select<T>(behind, a * (sum / length) + (b - a), a * (z / length) + b);
    } else if (z < T(0)) {
      const T sum = square / (length - z);
      value = a * sum + (b - a) * z;
      slope = a * (sum / length) + (b - a);
    } else {
      value = a * length + b * z;
      slope = a * (z / length) + b;
    }
  }
};

/// The derivatives of m = (x, y)/denominator by the point, for scale = 1/denominator and a denominator whose derivatives
/// are (c x, c y, by_z).
template <typename T>
SPLINERTIA_ALWAYS_INLINE inline void set_quotient_jacobian(auto& m, const T& x, const T& y, const T& scale, const T& c,
                                                           const T& by_z) {
  const T mx = -(m.x * scale), my = -(m.y * scale), across = mx * (c * y);
  m.by_point(0, 0) = scale + mx * (c * x);
  m.by_point(0, 1) = m.by_point(1, 0) = across;
  m.by_point(1, 1) = scale + my * (c * y);
  m.by_point(0, 2) = mx * by_z;
  m.by_point(1, 2) = my * by_z;
}
/// The derivatives of the same by two parameters, for those of the denominator.
template <typename T>
SPLINERTIA_ALWAYS_INLINE inline void set_quotient_parameters(auto& m, const T& scale, const T& by_first,
                                                             const T& by_second) {
  const T first = -(by_first * scale), second = -(by_second * scale);
  m.by_parameters(0, 0) = m.x * first;
  m.by_parameters(1, 0) = m.y * first;
  m.by_parameters(0, 1) = m.x * second;
  m.by_parameters(1, 1) = m.y * second;
}

/// α z / sqrt(square + z²) + 1 − α, without cancellation up to α = 1/2.
template <typename Scalar>
[[nodiscard]] Scalar blend_slope(const Scalar& alpha, const Scalar& square, const Scalar& z) {
  const Scalar length = square_root<Scalar>(square + z * z);
  return (Scalar(1) - (alpha + alpha)) + alpha * (difference_of_length<Scalar>(square, -z, length) / length);
}

/// A direction whose projection is (x, y), of any length that can be squared. Nothing outside the image.
template <typename Scalar>
[[nodiscard]] std::optional<Eigen::Vector3<Scalar>> unblend(const Scalar& x, const Scalar& y, const Scalar& alpha,
                                                            const Scalar& beta) {
  const Scalar one = direction_scale<Scalar>(x, y, Scalar(1)), a = x * one, b = y * one;
  const Scalar square = beta * (a * a + b * b), rest = Scalar(1) - alpha;
  const Scalar inside = one * one - (alpha - rest) * square;
  if (!(inside > Scalar(0))) return std::nullopt;
  const Scalar length = alpha * square_root(inside) + rest * one, depth = one * one - alpha * alpha * square;
  const Eigen::Vector3<Scalar> ray(a * length, b * length, depth);
  return ray * direction_scale<Scalar>(ray.x(), ray.y(), ray.z());
}

}  // namespace splinertia::detail
