// SPDX-License-Identifier: MIT
/// Equivalent degrees of freedom of estimates of Allan-type variances, for their confidence intervals.
///
/// The estimate is a mean of squares z_i² of M overlapping differences, which are normal with correlations ρ_l. Its
/// equivalent degrees of freedom are those of the chi-square distribution with the same ratio of variance to squared
/// mean, M/(1 + 2 Σ (1 − l/M) ρ_l²): Greenhall, Riley, "Uncertainty of stability variances based on finite
/// differences", PTTI 2003. A modified difference of order d of the phase x is, up to the factor 1/m, the plain
/// difference of order d + 1 of the sum of x. With p = 2 − α (4 − α if modified) and D = d (d + 1 if modified), both
/// therefore have the covariance δ^2D K_p at lag l·s with steps of m samples. K_p is the generalised autocovariance of
/// the spectrum |2 sin(π f τ₀)|^−p.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <splinertia/allan/phase_model.hpp>
#include <splinertia/detail/require.hpp>

namespace splinertia::allan::detail {

/// The differences that are squared: of the phase x, the integral of the rate, over steps of m samples. Order 2 is
/// Allan's, 3 Hadamard's, 1 a first difference of the phase. Modified: x is averaged over m samples before.
struct DifferenceShape {
  int differences = 2;
  bool modified = false;
};

/// The covariance of differences as a function of their lag, up to a factor. Lengths are in units of m samples.
class DifferenceCovariance {
 public:
  DifferenceCovariance(DifferenceShape shape, int alpha, std::int64_t m, bool averaged_phase)
      : m_(static_cast<double>(m)),
        log_m_(std::log(m_)),
        power_(2 - alpha + (shape.modified ? 2 : 0)),
        order_(shape.differences + (shape.modified ? 1 : 0)),
        averaged_(averaged_phase),
        averaging_step_(shape.modified ? 0 : 1) {
    binomials_[0] = 1;  // C(2·order, order − j)/C(2·order, order), alternating
    for (int j = 1; j <= order_; ++j) {
      const auto i = static_cast<std::size_t>(j);
      binomials_[i] = -binomials_[i - 1] * (order_ - j + 1) / (order_ + j);
    }
    variance_ = covariance(0);
  }

  [[nodiscard]] int power() const { return power_; }
  [[nodiscard]] int order() const { return order_; }

  /// The correlation of differences `lag` samples apart: an integer, or more than 15 from all multiples of m.
  [[nodiscard]] double correlation(double lag) const { return covariance(lag) / variance_; }

 private:
  [[nodiscard]] double covariance(double lag) const {
    double sum = binomials_[0] * kernel(lag);
    for (int j = 1; j <= order_; ++j) {
      sum += binomials_[static_cast<std::size_t>(j)] * (kernel(lag + j * m_) + kernel(lag - j * m_));
    }
    return sum;
  }

  [[nodiscard]] double kernel(double lag) const {
    const double k = std::abs(lag);
    if (!averaged_) return power_ % 2 == 0 ? even_kernel(k) : odd_kernel(k);
    if (averaging_step_ == 0) return continuous_kernel(k, power_ - 1);
    return m_ * m_ *
           (continuous_kernel(k - 1, power_ + 1) - 2 * continuous_kernel(k, power_ + 1) +
            continuous_kernel(k + 1, power_ + 1));
  }

  /// |t|^e, or |t|^e ln|t| for even e, with t = lag/m.
  [[nodiscard]] double continuous_kernel(double lag, int exponent) const {
    const double t = std::abs(lag) / m_;
    if (t == 0) return 0;
    double product = exponent % 2 == 0 ? std::log(t) : 1;
    for (int j = 0; j < exponent; ++j) product *= t;
    return product;
  }

  /// The Green's function of δ^p: k (k² − 1) (k² − 4) … (k² − (p/2 − 1)²); a unit impulse for p = 0.
  [[nodiscard]] double even_kernel(double k) const {
    if (power_ == 0) return k == 0 ? 1 : 0;
    const double t = k / m_;
    double product = t;
    for (int j = 1; j < power_ / 2; ++j) product *= t * t - (j / m_) * (j / m_);
    return product;
  }

  /// For odd p = 2q + 1, Γ(k + p/2)/Γ(k + 1 − p/2) is a polynomial in k² that the differences annihilate. The kernel is
  /// the derivative by p: Π (k² − (j − 1/2)²) (ψ(k + 1/2 + q) + ψ(k + 1/2 − q))/2, ψ the digamma function.
  [[nodiscard]] double odd_kernel(double k) const {
    const int q = (power_ - 1) / 2;
    const double t = k / m_;
    double product = 1;
    for (int j = 1; j <= q; ++j) product *= t * t - ((j - 0.5) / m_) * ((j - 0.5) / m_);
    if (k < 15.25) {
      const auto n = static_cast<int>(k);
      return product * (0.5 * (digamma_of_half(n + q) + digamma_of_half(std::abs(n - q))) - log_m_);
    }
    // Drops the terms below where they are small at all lags, apart from even polynomials, which cancel. A jump from
    // one lag to the next would not.
    if (q == 0 ? k > 1e5 : m_ > 1e5) return product * std::log(t);
    const auto correction = [](double x) {  // ψ(x + 1/2) − ln x, remainder 1e-11
      const double r = 1 / (x * x);
      return r * (1.0 / 24 - r * (7.0 / 960 - r * (31.0 / 8064)));
    };
    const double ratio = q / k;
    return product * (std::log(t) + 0.5 * (std::log1p(-ratio * ratio) + correction(k + q) + correction(k - q)));
  }

  /// ψ(n + 1/2) = −γ − 2 ln 2 + 2 Σ 1/(2 j − 1), 0 <= n < 19.
  [[nodiscard]] static double digamma_of_half(int n) {
    static constexpr auto values = [] {
      std::array<double, 19> psi{-1.96351002602142347944};
      for (std::size_t j = 1; j < psi.size(); ++j) psi[j] = psi[j - 1] + 2 / (2 * static_cast<double>(j) - 1);
      return psi;
    }();
    return values[static_cast<std::size_t>(n)];
  }

  double m_;
  double log_m_;
  int power_;
  int order_;
  bool averaged_;
  int averaging_step_;
  std::array<double, 5> binomials_{};
  double variance_ = 1;
};

/// Σ (1 − l/terms) ρ_l² over lags l >= 1 of `stride` samples. Short ranges are summed term by term. Elsewhere the sum
/// over (a, b] is replaced by the integral over (a + 1/2, b + 1/2), by Gauss–Legendre quadrature with 8 points. Its
/// intervals grow in proportion to the distance from the multiples of m, where ρ has kinks and logarithmic peaks.
class CorrelationSum {
 public:
  CorrelationSum(std::reference_wrapper<const DifferenceCovariance> covariance, std::int64_t m, std::int64_t terms,
                 std::int64_t stride)
      : covariance_(covariance),
        terms_(static_cast<double>(terms)),
        stride_(static_cast<double>(stride)),
        lags_per_step_(static_cast<double>(m) / stride_) {}

  /// The sum over lags of up to `steps` steps of m samples.
  [[nodiscard]] double up_to(double steps) const {
    const double last = (std::min)(terms_ - 1, std::floor(steps * lags_per_step_));
    double sum = 0, left = 0;
    for (int j = 1; left < last; ++j) {
      const bool beyond = j > covariance_.order();
      const double right = beyond ? last : (std::min)(last, std::round(j * lags_per_step_));
      sum += between(left, right);
      left = right;
    }
    return sum;
  }

 private:
  static constexpr double window = 16;  // lags on each side of a multiple of m that are summed one by one

  [[nodiscard]] double at(double l) const {
    const double rho = covariance_.correlation(l * stride_);
    return (1 - l / terms_) * rho * rho;
  }

  [[nodiscard]] double one_by_one(double after, double last) const {
    double sum = 0;
    for (double l = after + 1; l <= last; ++l) sum += at(l);
    return sum;
  }

  [[nodiscard]] double between(double left, double right) const {
    const double length = right - left;
    if (length <= 6 * window) return one_by_one(left, right);
    double sum = one_by_one(left, left + window) + one_by_one(right - window, right);
    if (covariance_.power() % 2 == 0) {  // a polynomial of degree 15 or less: the quadrature is exact
      return sum + quadrature(left + window + 0.5, right - window + 0.5);
    }
    // At its ends ρ² is as smooth as t^(p − 1) ln t: only for p = 1 must the intervals become that short there.
    const double shortest = covariance_.power() == 1 ? 0 : length / 256, middle = left + length / 2;
    for (double nearby = window + 0.5, distant = 0; left + nearby < middle; nearby = distant) {
      distant = (std::max)(6 * nearby, shortest);
      sum += quadrature(left + nearby, (std::min)(left + distant, middle));
    }
    for (double nearby = window - 0.5, distant = 0; right - nearby > middle; nearby = distant) {
      distant = (std::max)(6 * nearby, shortest);
      sum += quadrature((std::max)(right - distant, middle), right - nearby);
    }
    return sum;
  }

  [[nodiscard]] double quadrature(double from, double to) const {
    constexpr std::array<double, 4> nodes{0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                          0.96028985649753623168};
    constexpr std::array<double, 4> weights{0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                            0.10122853629037625915};
    const double center = (from + to) / 2, half = (to - from) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sum += weights[i] * (at(center - half * nodes[i]) + at(center + half * nodes[i]));
    }
    return sum * half;
  }

  const DifferenceCovariance& covariance_;
  double terms_;
  double stride_;
  double lags_per_step_;
};

/// The number of differences over steps of m samples in `phase_points` points, `stride` samples apart: 1 for
/// overlapping differences, m for those that share no rate. 0 if there are too few points.
[[nodiscard]] inline std::int64_t number_of_terms(DifferenceShape shape, std::int64_t m, std::int64_t phase_points,
                                                  std::int64_t stride = 1) {
  splinertia::detail::require(shape.differences >= 1 && shape.differences <= 3, "number_of_terms", "differences",
                              shape.differences, "1, 2 or 3");
  splinertia::detail::require(m >= 1, "number_of_terms", "averaging factor m", m, "an integer >= 1");
  splinertia::detail::require(stride >= 1, "number_of_terms", "stride", stride, "an integer >= 1");
  const std::int64_t steps = shape.differences + (shape.modified ? 1 : 0);
  const std::int64_t span = (std::max)(phase_points, std::int64_t(1)) - (shape.modified ? 0 : 1);
  return phase_points < 1 || span / m < steps ? 0 : (span - steps * m) / stride + 1;
}

/// The equivalent degrees of freedom of the mean of `terms` >= 1 squared differences over steps of m samples, `stride`
/// samples apart. The noise has the power law f^alpha of the rate's spectral density: 2 (quantisation), 1, 0 (white),
/// −1 (flicker), −2 (random walk), −3 or −4, with alpha + 2·differences > 1. 1 <= the result <= terms.
///
/// Relative error for the phase model: below 1e-4 (measured against all lags to 30 steps, m <= 5000), rounding only for
/// even alpha and up to 96 lags per step of m. Time: 0.1 to 10 µs up to there, at most 35 µs for 1 or 2 differences
/// (85 µs for 3), for any m and number of terms. Throws std::invalid_argument for other parameters.
[[nodiscard]] inline double equivalent_degrees_of_freedom(DifferenceShape shape, int alpha, std::int64_t m,
                                                          std::int64_t terms, std::int64_t stride = 1,
                                                          PhaseModel model = PhaseModel::sampled) {
  constexpr const char* name = "equivalent_degrees_of_freedom";
  splinertia::detail::require(shape.differences >= 1 && shape.differences <= 3, name, "differences", shape.differences,
                              "1, 2 or 3");
  splinertia::detail::require(alpha >= -4 && alpha <= 2, name, "alpha", alpha, "an integer from -4 to 2");
  splinertia::detail::require(alpha + 2 * shape.differences > 1, name, "alpha", alpha, "more than 1 - 2 * differences");
  splinertia::detail::require(m >= 1 && m <= 1'000'000'000'000'000, name, "averaging factor m", m,
                              "an integer from 1 to 10^15");
  splinertia::detail::require(terms >= 1, name, "number of terms", terms, "an integer >= 1");
  splinertia::detail::require(stride >= 1, name, "stride", stride, "an integer >= 1");
  const double lags_per_step = static_cast<double>(m) / static_cast<double>(stride);
  const bool averaged = model == PhaseModel::greenhall_riley && m <= 10000 &&
                        (std::min)(static_cast<double>(terms), (shape.differences + 1) * lags_per_step) <= 100;
  const DifferenceCovariance covariance(shape, alpha, m, averaged);
  double sum = 0;
  if (covariance.power() == 0) {  // correlated only at multiples of m
    for (std::int64_t j = 1; j <= shape.differences; ++j) {
      const std::int64_t l = j * m / stride;
      if (l * stride != j * m || l >= terms) continue;
      const double rho = covariance.correlation(static_cast<double>(j * m));
      sum += (1 - static_cast<double>(l) / static_cast<double>(terms)) * rho * rho;
    }
  } else {
    // Even powers: ρ is 0 beyond `order` steps. Odd powers: it decays as t^−2 or faster, and ρ² beyond 16 adds 2e-5.
    const double steps = averaged ? shape.differences + 1 : covariance.power() % 2 == 0 ? covariance.order() : 16;
    sum = CorrelationSum(covariance, m, terms, stride).up_to(steps);
  }
  const auto most = static_cast<double>(terms);
  return std::clamp(most / (1 + 2 * sum), 1.0, most);
}

}  // namespace splinertia::allan::detail
