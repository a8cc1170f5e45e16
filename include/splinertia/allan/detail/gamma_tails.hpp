// SPDX-License-Identifier: MIT
/// The tails P and Q of the incomplete gamma function, and their inverse.
///
/// Errors are measured against 50 digits (mpmath), for 2a from 0.1 to 1e12 and probabilities from 1e-12 to 1 − 1e-12.
/// Quantiles: within 1.1e-14 relative in double and 7e-18 in long double of 64 bits (46 ε and 64 ε). These are at
/// 2a = 0.1, where rounding the probability alone causes 20 ε; from 2a = 2 on quantiles in double are within 7 ε. Tails:
/// within 36 ε·(1 + condition of x). For other a results are still numbers, not NaN.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

namespace splinertia::allan::detail {

/// P(a, x) and Q(a, x) = 1 − P of the incomplete gamma function. The smaller one has a small relative error, which 1
/// minus the other would not have.
template <std::floating_point Scalar>
struct GammaTails {
  Scalar lower;
  Scalar upper;
};

/// From this shape a on, Temme's expansion is used around x = a, and Stirling's series for Γ(a).
inline constexpr int gamma_expansion_from = 30;

/// x − 1 − ln x at x = 1 + mu, which is mu²/2 near 0, without the cancellation.
template <std::floating_point Scalar>
[[nodiscard]] Scalar gamma_exponent(Scalar mu) {
  if (mu < Scalar(-0.5L) || mu > Scalar(1)) return mu - std::log1p(mu);
  // ln(1 + mu) = 2 artanh(r), r = mu/(2 + mu): the result is mu − 2r = r·mu, minus 2 (r³/3 + r⁵/5 + …).
  const Scalar r = mu / (Scalar(2) + mu), square = r * r;
  Scalar sum = 0, power = square;
  for (int k = 3; k < 200; k += 2) {
    const Scalar before = sum;
    sum += power / static_cast<Scalar>(k);
    power *= square;
    if (sum == before) break;
  }
  return r * (mu - Scalar(2) * sum);
}

/// Γ(a)·√(a/2π)·(e/a)^a, by Stirling's series. It tends to 1. Remainder below 1e-21 from a = 30 on.
template <std::floating_point Scalar>
[[nodiscard]] Scalar scaled_gamma(Scalar a) {
  constexpr std::array<Scalar, 7> coefficients{Scalar(1) / 12,    -Scalar(1) / 360, Scalar(1) / 1260,
                                               -Scalar(1) / 1680, Scalar(1) / 1188, -Scalar(691) / 360360,
                                               Scalar(1) / 156};
  const Scalar inverse = Scalar(1) / a, square = inverse * inverse;
  Scalar sum = 0;
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * square + coefficients[k];
  return std::exp(sum * inverse);
}

/// x^a·e^−x/Γ(a + 1), the density of the gamma distribution times x/a. 0 where it underflows.
template <std::floating_point Scalar>
[[nodiscard]] Scalar gamma_prefactor(Scalar a, Scalar x) {
  if (x <= Scalar(0)) return Scalar(0);
  if (a >= Scalar(gamma_expansion_from)) {
    constexpr Scalar two_pi = static_cast<Scalar>(6.283185307179586476925286766559005768L);
    return std::exp(-a * gamma_exponent((x - a) / a)) / (std::sqrt(two_pi * a) * scaled_gamma(a));
  }
  if (x > Scalar(1e5L)) return Scalar(0);  // e^−x alone underflows, and x^a could overflow
  return std::pow(x, a) * std::exp(-x) / std::tgamma(a + Scalar(1));
}

/// The coefficients f of η/(x/a − 1) = Σ f_n η^n with η²/2 = x/a − 1 − ln(x/a): 1, −1/3, 1/12, … The series is the
/// reciprocal of Σ c_{n+1} η^n, where x/a = 1 + Σ c_n η^n and the c follow from (x/a)' (x/a − 1) = η x/a. They converge
/// for |η| < 2√π.
template <std::floating_point Scalar>
[[nodiscard]] constexpr auto gamma_expansion_coefficients() {
  std::array<Scalar, 33> c{}, f{};
  c[0] = c[1] = f[0] = Scalar(1);
  for (std::size_t n = 2; n < c.size(); ++n) {
    Scalar sum = c[n - 1];
    for (std::size_t k = 2; k < n; ++k) sum -= c[k] * static_cast<Scalar>(n - k + 1) * c[n - k + 1];
    c[n] = sum / static_cast<Scalar>(n + 1);
  }
  for (std::size_t n = 1; n + 1 < f.size(); ++n) {
    for (std::size_t k = 1; k <= n; ++k) f[n] -= c[k + 1] * f[n - k];
  }
  return f;
}

/// Temme's uniform expansion: both tails are erfc(±η √(a/2))/2 plus a remainder. The power series of the remainder in η
/// has coefficients β with β_n = (n + 2) β_{n+2}/a + f_{n+1}, n downward. Gil, Segura, Temme, "Efficient and accurate
/// algorithms for the computation and inversion of the incomplete gamma function ratios", SIAM J. Sci. Comput. 34
/// (2012), section 2.5.
template <std::floating_point Scalar>
[[nodiscard]] GammaTails<Scalar> expanded_gamma_tails(Scalar a, Scalar mu) {
  static constexpr auto f = gamma_expansion_coefficients<Scalar>();
  constexpr Scalar two_pi = static_cast<Scalar>(6.283185307179586476925286766559005768L);
  const Scalar exponent = gamma_exponent(mu), eta = std::copysign(std::sqrt(Scalar(2) * exponent), mu);
  Scalar above = 0, beta = 0, sum = 0;
  for (std::size_t n = f.size() - 2; n-- > 0;) {
    const Scalar next = static_cast<Scalar>(n + 2) * above / a + f[n + 1];
    above = beta;
    beta = next;
    sum = sum * eta + beta;
  }
  const Scalar remainder = std::exp(-a * exponent) / (std::sqrt(two_pi * a) * scaled_gamma(a)) * sum;
  const Scalar argument = std::sqrt(a * exponent), half = Scalar(1) / 2;
  const Scalar sign = std::copysign(Scalar(1), mu);
  return {(std::max)(Scalar(0), half * std::erfc(-sign * argument) - remainder),
          (std::max)(Scalar(0), half * std::erfc(sign * argument) + remainder)};
}

/// P and Q of the incomplete gamma function for a, x > 0: Temme's expansion around x = a for large a, else the power
/// series of P for small x and Legendre's continued fraction of Q for large x. At most a few hundred terms.
template <std::floating_point Scalar>
[[nodiscard]] GammaTails<Scalar> gamma_tails(Scalar a, Scalar x) {
  constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  const Scalar one = 1, mu = (x - a) / a;
  if (a >= Scalar(gamma_expansion_from) && std::abs(mu) < Scalar(0.4L)) return expanded_gamma_tails(a, mu);
  const Scalar factor = gamma_prefactor(a, x);
  if (x < (std::max)(a, one)) {
    Scalar sum = 1, term = 1;
    for (Scalar n = a + one; term > epsilon * sum / 4; n += one) sum += term *= x / n;
    const Scalar lower = (std::min)(one, factor * sum);
    return {lower, one - lower};
  }
  // Q = a factor/(x + 1 − a − 1 (1 − a)/(x + 3 − a − …)), by the modified Lentz algorithm.
  constexpr Scalar tiny = (std::numeric_limits<Scalar>::min)() / epsilon;
  Scalar b = x + one - a, numerator = one / tiny, denominator = one / b, fraction = denominator, change = 0;
  for (Scalar n = one; std::abs(change - one) > epsilon && n < Scalar(1000); n += one) {
    const Scalar product = n * (a - n);
    b += Scalar(2);
    denominator = product * denominator + b;
    numerator = b + product / numerator;
    if (std::abs(denominator) < tiny) denominator = tiny;
    if (std::abs(numerator) < tiny) numerator = tiny;
    denominator = one / denominator;
    fraction *= change = denominator * numerator;
  }
  const Scalar upper = (std::min)(one, a * factor * fraction);
  return {one - upper, upper};
}

/// The x at which P(a, x) is `probability` (or Q, for `upper_tail`), 0 < probability <= 1/2. ln P is concave in ln x,
/// and ln Q in x, so that Newton's iteration on them converges from anywhere in the tail. A bracket guards it against
/// rounding. It starts from Wilson and Hilferty's x = a (1 − 1/9a + z/3√a)³ or, for small a, from the first term of the
/// series of P.
template <std::floating_point Scalar>
[[nodiscard]] Scalar gamma_quantile(Scalar a, Scalar probability, bool upper_tail) {
  const Scalar one = 1, log_probability = std::log(probability);
  // Abramowitz, Stegun, 26.2.23: the normal quantile within 4.5e-4.
  const Scalar t = std::sqrt(-Scalar(2) * log_probability);
  const Scalar normal = t - (Scalar(2.515517L) + t * (Scalar(0.802853L) + t * Scalar(0.010328L))) /
                                (one + t * (Scalar(1.432788L) + t * (Scalar(0.189269L) + t * Scalar(0.001308L))));
  const Scalar root = one - one / (Scalar(9) * a) + (upper_tail ? normal : -normal) / (Scalar(3) * std::sqrt(a));
  Scalar x = a * root * root * root;
  if (!upper_tail && (a < one || root < Scalar(0.5L)) && a < Scalar(gamma_expansion_from)) {
    x = std::exp((log_probability + std::log(std::tgamma(a + one))) / a);
    if (x < (std::numeric_limits<Scalar>::min)()) return x;  // P is x^a/Γ(a + 1) to the last bit
  }
  Scalar low = 0, high = (std::numeric_limits<Scalar>::max)();
  if (!(x > low)) x = a / Scalar(4);
  for (int i = 0; i < 200; ++i) {
    const GammaTails<Scalar> tails = gamma_tails(a, x);
    const Scalar tail = upper_tail ? tails.upper : tails.lower;
    const Scalar density = a * gamma_prefactor(a, x);  // times x: of ln x
    (tail > probability) == upper_tail ? low = x : high = x;
    Scalar next = -one;
    if (tail > Scalar(0) && density > Scalar(0)) {
      const Scalar step = (tail - probability) / probability;  // ln(tail/probability) without its cancellation
      const Scalar excess = (std::abs(step) < Scalar(0.5L) ? std::log1p(step) : std::log(tail / probability)) * tail;
      next = upper_tail ? x + x * (excess / density) : x * std::exp(-excess / density);
    }
    const bool done = std::abs(next - x) <= Scalar(2) * std::numeric_limits<Scalar>::epsilon() * x;
    if (done) return next;
    if (!(next > low && next < high)) {
      next = high < (std::numeric_limits<Scalar>::max)() ? low + (high - low) / Scalar(2) : Scalar(2) * x;
      if (next == low || next == high) return x;
    }
    x = next;
  }
  return x;
}

}  // namespace splinertia::allan::detail
