// SPDX-License-Identifier: MIT
/// Elementary functions in double as fixed sequences of operations. Unlike those of <cmath>, they give the same result
/// to the last bit with every compiler, at every optimisation level, with and without contraction. Relative errors are
/// a few eps. Random numbers and error terms use these functions. Random numbers are therefore the same everywhere;
/// samples are the same wherever the compiler does not contract the terms' own products and sums (-ffp-contract=off, or
/// no FMA).
#pragma once

#include <splinertia/detail/cpp20.hpp>
#include <splinertia/detail/pi.hpp>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

namespace splinertia::detail {

/// a·b + c, rounded once at run time, whatever the compiler may contract. In constant expressions it is rounded twice.
[[nodiscard]] constexpr double multiply_add(double a, double b, double c) {
  return std::is_constant_evaluated() ? a * b + c : std::fma(a, b, c);
}

/// 2ⁿ, 0 for n < −1022.
[[nodiscard]] constexpr double power_of_two(int n) {
  return n < -1022 ? 0 : std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52);
}

/// log(x) for finite x > 0 that is not denormal.
[[nodiscard]] constexpr double reproducible_log(double x) {
  constexpr double ln2 = 0.693147180559945309417;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffU) | 0x3ff0000000000000U);  // [1, 2)
  if (m > 1.4142135623730951) {
    m /= 2;
    ++exponent;
  }
  // log m = 2 artanh s, |s| < 0.172
  const double s = (m - 1) / (m + 1);
  const double s2 = s * s;
  double sum = 0;
  for (int n = 23; n >= 1; n -= 2) sum = multiply_add(sum, s2, 1.0 / n);
  return multiply_add(exponent, ln2, 2 * s * sum);
}

/// x = n ln 2 + r with |r| <= ln2/2, for −745 < x <= 0.
struct ReducedExponent {
  int n;
  double r;

  constexpr explicit ReducedExponent(double x)
      : n(static_cast<int>(x / ln2 - 0.5)), r(multiply_add(-n, rest_of_ln2, multiply_add(-n, ln2, x))) {}

 private:
  static constexpr double ln2 = 0.693147180559945309417;
  static constexpr double rest_of_ln2 = 2.319046813846299558e-17;  // ln 2 minus its rounded value
};

/// exp(x) for x <= 0. It is 0 below −708, where results become denormal.
[[nodiscard]] constexpr double reproducible_exp(double x) {
  if (x < -708) return 0;
  const ReducedExponent exponent(x);
  double sum = 1;
  for (int k = 14; k >= 1; --k) sum = multiply_add(sum, exponent.r / k, 1);
  return sum * power_of_two(exponent.n);
}

/// exp(x) − 1 for x <= 0.
[[nodiscard]] constexpr double reproducible_expm1(double x) {
  if (x < -60) return -1;
  const ReducedExponent exponent(x);
  double sum = 1;
  for (int k = 14; k >= 2; --k) sum = multiply_add(sum, exponent.r / k, 1);
  const double power = power_of_two(exponent.n);
  return multiply_add(power, exponent.r * sum, power - 1);
}

struct SineCosine {
  double sine, cosine;
};

/// sin(2πx) and cos(2πx) for finite x. The absolute error is a few eps beyond that of x itself: whole turns are
/// subtracted without error.
[[nodiscard]] constexpr SineCosine reproducible_sine_cosine(double turns) {
  constexpr double two_pi = 6.28318530717958647693;
  double fraction = turns;  // beyond 2⁵² turns every double is a whole number
  if (!(turns > -0x1p52 && turns < 0x1p52)) {
    fraction = 0;
  } else {
    fraction -= static_cast<double>(static_cast<std::int64_t>(turns));  // (−1, 1)
  }
  const int quarter = static_cast<int>(fraction * 4 + (fraction < 0 ? -0.5 : 0.5));
  const double angle = two_pi * (fraction - quarter / 4.0);  // |angle| <= π/4
  const double negative_square = -angle * angle;
  double sine = 1, cosine = 1;
  for (int k = 9; k >= 1; --k) {
    sine = multiply_add(sine, negative_square / (2 * k * (2 * k + 1)), 1);
    cosine = multiply_add(cosine, negative_square / (2 * k * (2 * k - 1)), 1);
  }
  sine *= angle;
  switch (quarter & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

/// Whether functions of this Scalar are computed by those above, in double.
template <typename Scalar>
inline constexpr bool is_reproducible = std::same_as<Scalar, double> || std::same_as<Scalar, float>;

/// exp(−x) for x >= 0.
template <typename Scalar>
[[nodiscard]] Scalar exp_minus(const Scalar& x) {
  if constexpr (is_reproducible<Scalar>) {
    return static_cast<Scalar>(reproducible_exp(-static_cast<double>(x)));
  } else {
    using std::exp;
    return exp(-x);
  }
}

/// −expm1(−x) = 1 − exp(−x) for x >= 0, to full relative accuracy.
template <typename Scalar>
[[nodiscard]] Scalar one_minus_exp_minus(const Scalar& x) {
  if constexpr (is_reproducible<Scalar>) {
    return static_cast<Scalar>(-reproducible_expm1(-static_cast<double>(x)));
  } else {
    using std::expm1;
    return -expm1(-x);
  }
}

/// ln x, for x > 0.
template <typename Scalar>
[[nodiscard]] Scalar logarithm(const Scalar& x) {
  if constexpr (is_reproducible<Scalar>) {
    return static_cast<Scalar>(reproducible_log(static_cast<double>(x)));
  } else {
    using std::log;
    return log(x);
  }
}

/// sin(2πx) and cos(2πx).
template <typename Scalar>
struct Oscillation {
  Scalar sine, cosine;

  explicit Oscillation(const Scalar& turns) {
    if constexpr (is_reproducible<Scalar>) {
      const auto [s, c] = reproducible_sine_cosine(static_cast<double>(turns));
      sine = static_cast<Scalar>(s);
      cosine = static_cast<Scalar>(c);
    } else {
      using std::sin, std::cos;
      const Scalar angle = Scalar(2) * pi_of<Scalar>() * turns;
      sine = sin(angle);
      cosine = cos(angle);
    }
  }
};

}  // namespace splinertia::detail
