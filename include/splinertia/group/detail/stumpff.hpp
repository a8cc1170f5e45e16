// SPDX-License-Identifier: MIT
/// The coefficient functions of exp, its Jacobians, their inverses and derivatives on every group that contains a
/// rotation: the Stumpff functions
///
///   c_n(X) = Σ_m (−X)^m / (2m + n)!,   X = θ²
///   c₀ = cos θ, c₁ = sin θ/θ, c₂ = (1 − cos θ)/θ², c₃ = (θ − sin θ)/θ³, c₄ = (θ²/2 + cos θ − 1)/θ⁴, …
///
/// The closed forms cancel for small θ, more so for higher n. No threshold between closed form and series suits every
/// scalar. Instead, from θ = 0 to π, short polynomials at half the angle give the two highest functions. The recursion
/// c_n = 1/n! − X c_{n+2} gives the lower ones. Doubling the angle adds only positive terms (except for c₀ = 2h₀² − 1).
/// This needs no cancellation, division by a variable, square root, trigonometric function or special case. Up to 2π
/// the angle is doubled twice. Beyond 2π the closed forms are used; nothing cancels there.
///
/// Relative error (units of eps; measured on [0, π], float, double and long double): c₁ … c₇ and
/// inverse_jacobian_coefficient at most 2.5.
/// Source: K. Stumpff, Himmelsmechanik I (1959), ch. V; doubling as in J. M. A. Danby, Fundamentals of Celestial
/// Mechanics (1988), 6.9.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/detail/fixed_array.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <splinertia/group/detail/economized_series.hpp>
#include <type_traits>
#include <utility>

namespace splinertia::detail {

/// The type of constants that are used with Scalar: a built-in type if it is precise enough, else Scalar itself. For
/// automatic differentiation types such as ceres::Jet, products with a built-in type are cheaper.
template <typename Scalar>
using Constant = std::conditional_t<
    (std::numeric_limits<Scalar>::digits <= std::numeric_limits<float>::digits), float,
    std::conditional_t<
        (std::numeric_limits<Scalar>::digits <= std::numeric_limits<double>::digits), double,
        std::conditional_t<(std::numeric_limits<Scalar>::digits <= std::numeric_limits<long double>::digits),
                           long double, Scalar>>>;

/// c_n(X) and, at half the angle, c_n(X/4), n = 0 … N.
template <typename Scalar, int N>
struct StumpffValues {
  FixedArray<Scalar, N + 1> full;
  FixedArray<Scalar, N + 1> half;
};

/// The upper end of the argument of the polynomials: just above (π/2)², the square of half of θ = π.
inline constexpr long double stumpff_reach = 2.4675L;

/// The number of Taylor terms of c_n for which the first omitted term, relative to c_n(0), is below eps/2:
/// x^terms n!/(2 terms + n)! < 2^−digits with x = (π/2)².
[[nodiscard]] constexpr int stumpff_terms(int n, int digits) {
  long double remainder = 1;
  long double goal = 1;
  for (int i = 0; i < digits; ++i) goal /= 2;
  int terms = 0;
  while (remainder >= goal) {
    remainder *= stumpff_reach / static_cast<long double>((2 * terms + n + 1) * (2 * terms + n + 2));
    ++terms;
  }
  return terms;
}

/// The Taylor coefficients of c_n: (−1)^m/(2m + n)! for m = 0 … Terms − 1.
template <typename Real, int Terms>
[[nodiscard]] constexpr FixedArray<Real, Terms> taylor_series(int n) {
  FixedArray<Real, Terms> table{};
  Real factorial = Real(1);
  for (int i = 2; i <= n; ++i) factorial *= Real(i);
  for (int m = 0; m < Terms; ++m) {
    table[static_cast<std::size_t>(m)] = Real(1) / factorial;
    factorial *= Real(2 * m + n + 1);
    factorial *= -Real(2 * m + n + 2);
  }
  return table;
}

/// Σ_m a[m] x^m, with even and odd powers summed separately: two independent chains of half the length, which a
/// processor computes side by side. Their lengths differ by at most one term. If the terms of the alternating sum fall
/// in size, neither chain cancels.
template <typename Scalar, typename Real, std::size_t Terms>
[[nodiscard]] inline Scalar polynomial(const std::array<Real, Terms>& a, const Scalar& x) {
  static_assert(Terms >= 2);
  const Scalar y = x * x;
  const auto every_other = [&]<std::size_t... Index>(std::size_t highest, std::index_sequence<Index...>) {
    Scalar sum(a[highest]);
    ((sum = sum * y + a[highest - 2 * (Index + 1)]), ...);
    return sum;
  };
  constexpr std::size_t even = (Terms - 1) / 2, odd = (Terms - 2) / 2;
  return every_other(2 * odd + 1, std::make_index_sequence<odd>{}) * x +
         every_other(2 * even, std::make_index_sequence<even>{});
}

/// c_n(x), n ≥ 2, for 0 ≤ x ≤ (π/2)². Built-in types narrower than long double, alone or in SIMD packs (SimdPack), use the
/// economized series: it is one or two terms shorter, with an error of at most eps/8 of c_n(0). Other types use the
/// Taylor series: long double, because its coefficients cannot be rounded from a wider type; automatic differentiation
/// types, because the derivatives of the economized series are less accurate; and types with still more digits.
template <int n, typename Scalar>
[[nodiscard]] inline Scalar stumpff_series(const Scalar& x) {
  using Real = Constant<Scalar>;
  constexpr int digits = std::numeric_limits<Scalar>::digits;
  constexpr bool built_in = std::is_floating_point_v<Scalar> || is_simd_pack<Scalar>;
  if constexpr (built_in && digits < std::numeric_limits<long double>::digits) {
    constexpr int terms =
        economized_terms(n, stumpff_reach, static_cast<long double>(std::numeric_limits<Real>::epsilon()) / 8);
    constexpr auto a = economized_series<Real, terms>(n, stumpff_reach);
    return polynomial(a, x);
  } else if constexpr (std::is_floating_point_v<Real>) {
    constexpr auto a = taylor_series<Real, stumpff_terms(n, digits)>(n);
    return polynomial(a, x);
  } else {
    static const auto a = taylor_series<Real, stumpff_terms(n, digits)>(n);
    return polynomial(a, x);
  }
}

/// h_n = c_n(x), n = 0 … N, for 0 ≤ x ≤ (π/2)²: series for the two highest, h_n = 1/n! − x h_{n+2} for the others.
template <int N, typename Scalar>
[[nodiscard]] inline FixedArray<Scalar, N + 1> stumpff_small(const Scalar& x) {
  static_assert(N % 2 == 1 && N <= 7, "the recursion descends in steps of two");
  // Start higher than N if N is small: the series of higher functions need fewer terms, and the recursion gives the low
  // ones their best accuracy.
  constexpr int top = N == 1 ? 3 : N < 5 ? 5 : N;
  constexpr std::array<int, 6> factorial{1, 1, 2, 6, 24, 120};
  FixedArray<Scalar, top + 1> h;
  h[top] = stumpff_series<top>(x);
  h[top - 1] = stumpff_series<top - 1>(x);
  for (std::size_t n = top - 1; n-- > 0;) h[n] = Constant<Scalar>(1) / Constant<Scalar>(factorial[n]) - x * h[n + 2];
  FixedArray<Scalar, N + 1> result;
  std::copy_n(h.begin(), N + 1, result.begin());
  return result;
}

/// c_n(4x), n = 0 … N, from h_n = c_n(x).
template <typename Scalar, std::size_t Size>
[[nodiscard]] inline std::array<Scalar, Size> stumpff_doubled(const std::array<Scalar, Size>& h) {
  using Real = Constant<Scalar>;
  std::array<Scalar, Size> c;
  c[0] = Real(2) * h[0] * h[0] - Real(1);
  c[1] = h[0] * h[1];
  if constexpr (Size > 3) {
    c[2] = h[1] * h[1] / Real(2);
    c[3] = (h[2] + h[0] * h[3]) / Real(4);
  }
  if constexpr (Size > 5) {
    c[4] = h[3] * (Real(1) + h[1]) / Real(8);
    c[5] = (h[4] + h[5] + h[2] * h[3]) / Real(16);
  }
  if constexpr (Size > 7) {
    c[6] = (h[3] / Real(6) + h[5] * (Real(1) + h[1])) / Real(32);
    c[7] = (h[6] + h[7] + h[4] / Real(6) + h[2] * h[5]) / Real(64);
  }
  return c;
}

/// c_n(X), n = 0 … N, by the closed forms, for θ > π, where they lose at most one digit.
template <int N, typename Scalar>
[[nodiscard]] inline FixedArray<Scalar, N + 1> stumpff_large(const Scalar& X) {
  using Real = Constant<Scalar>;
  using std::cos, std::sin, std::sqrt;
  const Scalar theta = sqrt(X);
  const Scalar chord = sin(theta / Real(2)) / theta;
  FixedArray<Scalar, N + 1> c;
  c[0] = cos(theta);
  c[1] = sin(theta) / theta;
  if constexpr (N > 1) c[2] = Real(2) * chord * chord;
  constexpr std::array<int, 6> factorial{1, 1, 2, 6, 24, 120};
  for (std::size_t n = 3; n <= N; ++n) c[n] = (Real(1) / Real(factorial[n - 2]) - c[n - 2]) / X;
  return c;
}

/// c_n(X) and c_n(X/4), n = 0 … N, for every X = θ² ≥ 0. N is 1 (exp of a rotation), 3 (its Jacobian),
/// 5 (Jacobian of a rigid motion) or 7 (derivatives of Jacobians).
template <int N, typename Scalar>
[[nodiscard]] inline StumpffValues<Scalar, N> stumpff(const Scalar& X) {
  using Real = Constant<Scalar>;
  const Scalar x = X / Real(4);
  const Real small = static_cast<Real>(stumpff_reach);
  StumpffValues<Scalar, N> values;
  if (x <= small) {
    values.half = stumpff_small<N>(x);
    values.full = stumpff_doubled(values.half);
  } else if (x <= Real(4) * small) {
    values.half = stumpff_doubled(stumpff_small<N>(Scalar(x / Real(4))));
    values.full = stumpff_doubled(values.half);
  } else {
    values.half = stumpff_large<N>(x);
    values.full = stumpff_large<N>(X);
  }
  return values;
}

/// The same for SIMD packs, for X ≤ π² only: the lanes of a pack cannot take different branches.
template <int N, typename T, int Size, int Bytes>
[[nodiscard]] inline StumpffValues<SimdPack<T, Size, Bytes>, N> stumpff(const SimdPack<T, Size, Bytes>& X) {
  using L = SimdPack<T, Size, Bytes>;
  StumpffValues<L, N> values;
  values.half = stumpff_small<N>(L(X / T(4)));
  values.full = stumpff_doubled(values.half);
  return values;
}

/// E = (1 − (θ/2) cot(θ/2))/θ², the only coefficient of the inverse Jacobian besides 1 and 1/2:
/// J_l⁻¹ = I − φ^/2 + E φ^². Regular for θ < 2π. Needs N ≥ 3.
template <typename Scalar, int N>
[[nodiscard]] inline Scalar inverse_jacobian_coefficient(const StumpffValues<Scalar, N>& c) {
  return (c.half[2] - c.half[3]) / (Constant<Scalar>(4) * c.half[1]);
}

/// (dc_n/dθ)/θ = n c_{n+2} − c_{n+1}, n = 1 … 5. Needs N ≥ n + 2. This difference cancels towards π (n = 3: by a factor
/// of 5). The code therefore differentiates the doubling formula of c_n, where the differences are those at half the
/// angle.
template <int n, typename Scalar, int N>
[[nodiscard]] inline Scalar stumpff_derivative(const StumpffValues<Scalar, N>& c) {
  using Real = Constant<Scalar>;
  static_assert(1 <= n && n <= 5);
  const auto& h = c.half;
  const Scalar d1 = h[3] - h[2];
  if constexpr (n == 1) return (h[0] * d1 - h[1] * h[1]) / Real(4);
  if constexpr (n == 2) return h[1] * d1 / Real(4);
  if constexpr (n == 3) return (Real(2) * h[4] - h[3] - h[1] * h[3] + h[0] * (Real(3) * h[5] - h[4])) / Real(16);
  if constexpr (n == 4) return ((Real(3) * h[5] - h[4]) * (Real(1) + h[1]) + h[3] * d1) / Real(32);
  if constexpr (n == 5) {
    const Scalar d2 = Real(2) * h[4] - h[3], d3 = Real(3) * h[5] - h[4];
    return (Real(4) * h[6] - h[5] + Real(5) * h[7] - h[6] + d2 * h[3] + h[2] * d3) / Real(64);
  }
}

/// (dE/dθ)/θ. Needs N ≥ 5.
template <typename Scalar, int N>
[[nodiscard]] inline Scalar inverse_jacobian_coefficient_derivative(const StumpffValues<Scalar, N>& c) {
  using Real = Constant<Scalar>;
  const auto& h = c.half;
  const Scalar numerator = (Real(3) * h[4] - h[3] - Real(3) * h[5]) / Real(4);
  const Scalar h1_derivative = (h[3] - h[2]) / Real(4);
  return (numerator - (h[2] - h[3]) * h1_derivative / h[1]) / (Real(4) * h[1]);
}

}  // namespace splinertia::detail
