// SPDX-License-Identifier: MIT
/// Equivalent degrees of freedom of an estimate of the total variance, for its confidence interval.
///
/// The total variance is the mean square of n − 1 second differences z of the phase, which is extended at both ends by
/// reflection (TotalDeviation). Its equivalent degrees of freedom are those of the chi-square distribution with the
/// same ratio of variance to squared mean, (Σ_i E z_i²)²/Σ_ij (E z_i z_j)². The reflection makes z a sine series. Its
/// coefficients are those of the cosine transform of the rates y:
///
///   Σ_i z_i² = 8/n Σ_q (Σ_k y_k cos((2k + 1) θ_q))² sin⁴(m θ_q)/sin²θ_q,   θ_q = πq/(2n),   q = 1 … n − 1.
///
/// The coefficients of white rates and of a random walk are independent. Those of white phase are correlated by the
/// first and the last phase only. For these three noises both sums are polynomials of n and m. For the others they have
/// the same form, with terms fitted to the covariance matrices of 8 to 3000 rates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <splinertia/allan/detail/degrees_of_freedom.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <stdexcept>

namespace splinertia::allan::detail {

/// Moments of the sum of squares Σ z_i² that the total variance averages, in a unit that depends on the noise.
struct TotalSquares {
  double mean;           ///< Σ_i E z_i²
  double half_variance;  ///< Σ_ij (E z_i z_j)²
};

/// The moments for n rates, averaging factor m, 1 <= m <= n/2, and the power law f^alpha, alpha from −4 to 2. Exact for
/// 2, 0 and −2. Those for 1 and −1 hold for m >= 2: nothing is reflected for m = 1.
[[nodiscard]] inline TotalSquares total_squares(int alpha, double m, double n) {
  constexpr double pi = std::numbers::pi;
  const double m2 = m * m, m4 = m2 * m2, log_m = std::log(m), share = m / n;
  const bool even = std::fmod(m, 2) == 0;
  switch (alpha) {
    case 2:
      return {6 * n + 8 * m - (even ? 6 : 14),
              70 * n + 32 * m2 + 112 * m - (even ? 122 : 250) + (2 * m == n ? 4 * m - 2 : 0)};
    case 1:  // all terms reflected at an end share its phase, which gives the terms with log m
      return {
          6 / pi * n * (log_m + 1.73246 + 5 / (96 * m2)) + m * (8 / pi * log_m - 0.57666) + (even ? 1.33149 : -2.63781),
          20 * n * m + m2 * (log_m * (32 / (pi * pi) * log_m + 13.867) + 2.4355) + m * (even ? 1.093 : -7.6244)};
    case 0:
      return {2 * n * m - (even ? 0 : 2), n * m * (8 * m2 + 10) / 3 - (even ? 0 : 8)};
    case -1:
      return {(n * (4 * std::numbers::ln2 * m2 + 0.7358 * log_m + 1.1992) - 1.32847 * m2 * m +
               m * (even ? 0.93482 : 0.13156)) /
                  pi,
              n * m * (m4 + m2 + 1) * 2 / 3 - m4 * (m2 * (0.514898 - 0.63372 * std::pow(share, 4)) - 0.22928)};
    case -2:
      return {n * m * (2 * m2 + 1) / 3 - m4 / 2 - (even ? 0 : 0.5),
              n * m * (((151 * m2 + 70) * m2 + 49) * m2 + 45) / 315 - m4 * m4 / 2 - (even ? 0 : 0.5)};
    case -3:
      return {(1.52172 - std::log(share) - share * (2.21323 - 1.15866 * share) + 0.75681 / m2 + 2.2106 / (n * m)) / pi,
              0.562554 - share * (0.845632 + share * (0.158563 - 0.543576 * share)) + 1.14671 / (n * m)};
    default: {  // −4: the noise has become little else than a drift
      const double u = std::sqrt(m2 - 1) / n;
      return {1, 1 / (1.5 - u * (1.3848 - u * (1.1907 - 0.3098 * u)) - 4.96 / (n * n * m2))};
    }
  }
}

/// The equivalent degrees of freedom of the total variance (TotalDeviation) over m samples of `rates` rates, of noise
/// with the power law f^alpha of the rate's spectral density: 2 (quantisation), 1, 0 (white), −1 (flicker), −2 (random
/// walk), −3 or −4. At least 1.
///
/// PhaseModel::sampled, at most rates − 1: exact for 2, 0 and −2. Largest relative error against covariance matrices of
/// 8 to 7000 rates, in brackets for 64 rates and more: 0.8 % (0.2 %) for 1, 0.6 % (0.2 %) for −1, 3.3 % (2 %) for −3,
/// 0.5 % (0.2 %) for −4. Neither the total nor the Allan variance converges for −3 and −4: these are the degrees of
/// noise that begins with the log.
///
/// PhaseModel::greenhall_riley: b·rates/m − c where published (Howe, Riley (ed.), NIST SP 1065 (2008)), with (b, c) =
/// (1.5, 0) for 0, (1.168, 0.222) for −1, (0.927, 0.358) for −2; the others as `sampled`. These are for a continuous
/// phase. At m = 1, 2, 4, 8, 16 their ratio to the exact value is 2.26, 1.31, 1.08, 1.02, 1.005 for 0; 1.44, 0.98,
/// 0.97, 0.98, 0.99 for −1; 0.93, 0.90, 0.97, 0.99, 1.002 for −2; for longer m it is within 1.2 % of 1 (256 rates).
///
/// The mean of the total variance differs from Allan's by a share of m/rates of it: −0.48 for −1 and −0.75 for −2 (SP
/// 1065), none for 0, 4/3 for 2, and 0.8 (m = 8) to 1.03 (m = 1500) for 1. Intervals with these degrees of freedom are
/// about its own mean.
///
/// Intervals hold as often as they say or more: a chi-square distribution is wider than that of few squares, or of many
/// small and a few large ones. In 20 000 logs of 512 rates, intervals of 68.3 % hold in 68 to 70 % up to m = 64 for 0,
/// −1, −2 (95 %: 95 to 96 %); at m = n/2 in 73, 72 and 74 % (97 %), in 81 and 78 % (96 to 97 %) for 2 and 1; and at all
/// m in 73 to 81 % (97 %) for −3 and −4.
///
/// Throws std::invalid_argument for other alpha, m < 1, and m > rates/2, for which there is no TotalDeviation.
[[nodiscard]] inline double total_degrees_of_freedom(int alpha, std::int64_t m, std::int64_t rates,
                                                     PhaseModel model = PhaseModel::sampled) {
  constexpr const char* name = "total_degrees_of_freedom";
  splinertia::detail::require(alpha >= -4 && alpha <= 2, name, "alpha", alpha, "an integer from -4 to 2");
  splinertia::detail::require(rates >= 2, name, "number of rates", rates, "an integer >= 2");
  if (m < 1 || m > rates / 2) {
    splinertia::detail::refuse<std::invalid_argument>(name, ": averaging factor m is ", m, ", expected 1 to ",
                                                      rates / 2, ", half the number of rates");
  }
  if (model == PhaseModel::greenhall_riley && alpha <= 0 && alpha >= -2) {
    const double ratio = static_cast<double>(rates) / static_cast<double>(m);
    return (std::max)(1.0, alpha == 0 ? 1.5 * ratio : alpha == -1 ? 1.168 * ratio - 0.222 : 0.927 * ratio - 0.358);
  }
  if (m == 1 && (alpha == 1 || alpha == -1)) return equivalent_degrees_of_freedom({}, alpha, 1, rates - 1);
  const TotalSquares squares = total_squares(alpha, static_cast<double>(m), static_cast<double>(rates));
  return std::clamp(squares.mean * squares.mean / squares.half_variance, 1.0, static_cast<double>(rates - 1));
}

}  // namespace splinertia::allan::detail
