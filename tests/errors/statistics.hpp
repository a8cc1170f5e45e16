// SPDX-License-Identifier: MIT
/// Records of error terms, and statistics of them with standard errors that are exact, whatever the correlation: the
/// records are Gaussian with zero mean and covariance C, so that Cov(x_i x_j, x_k x_l) = C_ik C_jl + C_il C_jk
/// (Isserlis, Biometrika 12 (1918)).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/random/detail/random_bits.hpp>
#include <utility>
#include <vector>

namespace splinertia::testing {

using namespace splinertia::detail;

/// What a record gives, what theory says, and theory's standard error of the former.
struct Estimate {
  double value, expected, standard_error;
};

/// How far an estimate is off, in standard errors.
[[nodiscard]] inline double off(const Estimate& e) { return std::abs(e.value - e.expected) / e.standard_error; }

inline constexpr std::size_t million = 1'000'000;
inline constexpr std::array<double, 3> rates = {50, 200, 1000};

template <typename Scalar>
[[nodiscard]] PerAxis<Scalar> per_axis(const double (&x)[3]) {
  return {static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]), static_cast<Scalar>(x[2])};
}

/// Times between samples, s; that before the first one is the sampling interval.
using Intervals = std::vector<double>;

[[nodiscard]] inline Intervals regular(double rate, std::size_t n = million) { return Intervals(n, 1 / rate); }

/// Uniform in [0.5, 1.5]/rate.
[[nodiscard]] inline Intervals irregular(double rate, std::size_t n = million) {
  RandomBits bits(StreamKey(77) / "intervals");
  Intervals intervals(n);
  for (double& h : intervals) h = (0.5 + static_cast<double>(bits() >> 11) * 0x1p-53) / rate;
  return intervals;
}

/// Of the samples: zero for the first.
[[nodiscard]] inline std::vector<double> times(const Intervals& intervals) {
  std::vector<double> t(intervals.size(), 0.0);
  for (std::size_t i = 1; i < t.size(); ++i) t[i] = t[i - 1] + intervals[i];
  return t;
}

/// The errors that a model puts into the samples of one run.
struct Record {
  std::array<std::vector<double>, 3> axes;
  bool all_bias = true;  // what is reported as bias is all of the error, in every sample
  bool no_bias = true;   // … none of it
};

template <typename Scalar, typename Generator = Xoshiro256, typename... Terms>
[[nodiscard]] Record record(const ErrorModel<Terms...>& model, const Intervals& intervals, std::uint64_t seed) {
  auto state = model.template start<3, Generator>(StreamKey(seed) / "gyro");
  Record result;
  for (auto& axis : result.axes) axis.reserve(intervals.size());
  double elapsed = 0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (i > 0) elapsed += intervals[i];
    SensorSample<Scalar> sample{Eigen::Vector3<Scalar>::Zero(), Eigen::Vector3<Scalar>::Zero(),
                                static_cast<Scalar>(intervals[i]), i == 0, static_cast<Scalar>(elapsed)};
    model.apply(sample, state);
    for (int axis = 0; axis < 3; ++axis)
      result.axes[static_cast<std::size_t>(axis)].push_back(static_cast<double>(sample.value[axis]));
    result.all_bias = result.all_bias && sample.bias == sample.value;
    result.no_bias = result.no_bias && sample.bias.isZero(0);
  }
  return result;
}

/// The mean of x_i y_i, of two records that are independent and white with unit variance.
[[nodiscard]] inline Estimate mean_product(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  return {std::inner_product(x.begin(), x.end(), y.begin(), 0.0) / n, 0, 1 / std::sqrt(n)};
}

/// The mean of x_i x_{i+lag} of a stationary record of autocovariance C(l), which is nothing from lag `reach` on.
/// Variance 1/M Σ_l (1 − |l|/M)(C(l)² + C(l + lag) C(l − lag)): Bartlett, J. R. Stat. Soc. Suppl. 8 (1946).
template <typename Covariance>
[[nodiscard]] Estimate autocovariance(const std::vector<double>& x, const Covariance& C, std::size_t lag,
                                      std::size_t reach) {
  const std::size_t n = x.size() - lag;
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += x[i] * x[i + lag];
  const auto M = static_cast<double>(n);
  double variance = (C(0) * C(0) + C(lag) * C(lag)) / M;
  for (std::size_t l = 1; l < std::min(n, reach + lag); ++l) {
    const double c = C(l), product = C(l + lag) * C(l > lag ? l - lag : lag - l);
    variance += 2 * (1 - static_cast<double>(l) / M) * (c * c + product) / M;
  }
  return {sum / M, C(lag), std::sqrt(variance)};
}

/// That of white noise of variance 1.
[[nodiscard]] inline Estimate white_autocovariance(const std::vector<double>& x, std::size_t lag) {
  return autocovariance(x, [](std::size_t l) { return l == 0 ? 1.0 : 0.0; }, lag, 1);
}

/// The Allan variance of averages over m samples each, without overlap: the mean of d²/2, d the differences of
/// neighbouring averages, whose autocovariance is D(l). Variance 1/(2M) Σ_l (1 − |l|/M) D(l)².
template <typename Covariance>
[[nodiscard]] Estimate allan_variance(const std::vector<double>& x, std::size_t m, const Covariance& D,
                                      std::size_t reach) {
  std::vector<double> averages(x.size() / m, 0.0);
  for (std::size_t i = 0; i < averages.size(); ++i) {
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(i * m);
    averages[i] = std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(m), 0.0) / static_cast<double>(m);
  }
  const std::size_t n = averages.size() - 1;
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += std::pow(averages[i + 1] - averages[i], 2) / 2;
  const auto M = static_cast<double>(n);
  double variance = D(0) * D(0) / (2 * M);
  for (std::size_t l = 1; l < std::min(n, reach); ++l) variance += (1 - static_cast<double>(l) / M) * D(l) * D(l) / M;
  return {sum / M, D(0) / 2, std::sqrt(variance)};
}

}  // namespace splinertia::testing
