// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <splinertia/allan/integrated_signal.hpp>
#include <vector>

namespace splinertia::allan {

namespace detail {

/// noise_type() needs at least fewest_averages averages and reads only the first most_averages.
inline constexpr std::int64_t fewest_averages = 30, most_averages = std::int64_t{1} << 16;

/// The exponent alpha of n averages that were differenced d = 0, 1 or 2 times; nothing if they must be differenced once
/// more. With w_i the values less their mean: lag0 = Σ w_i², lag1 = Σ w_i·w_{i+1}.
template <typename Scalar>
[[nodiscard]] std::optional<int> power_law(Scalar lag0, Scalar lag1, Scalar n, int d) {
  constexpr int most_differences = 2, steepest = -4;
  if (!(lag0 > 0)) return -2 * d;  // equal averages have no slope
  // Stable32 has the factor (n − 1)/n; with it alpha agrees with its published tables.
  // Noise that is stationary after d differences has r1 >= −1/2. A beat of period 2 can be lower.
  const Scalar r1 = (std::max)(lag1 / lag0 * (n - 1) / n, Scalar(-1) / 2);
  const Scalar delta = r1 / (1 + r1);
  if (delta >= Scalar(1) / 4 && d < most_differences) return std::nullopt;
  return (std::max)(static_cast<int>(-std::lround(2 * delta)) - 2 * d, steepest);  // a smooth drift would be steeper
}

}  // namespace detail

/// The power law f^alpha of the spectrum of averages over m samples, from their autocorrelation at lag 1 (Riley and
/// Greenhall, "Power law noise identification using the lag 1 autocorrelation", EFTF 2004). For an IMU:
///
///   alpha   2 or 1             0            −1                     −2            −3, −4
///           quantization (Q)   white (N)    bias instability (B)   walk (K)      ramp (R), drift
///
/// At least 30 averages are needed. A longer m gets the type of the longest m with 30 averages, or white if that type
/// is 1 or 2: by chance every seventh set of 30 averages of white noise looks like 1 or 2, and intervals based on that
/// type are several times too narrow. Logs of fewer than 30 samples count as white noise. Stable32 uses Barnes' ratio
/// B1 (of the variance to the Allan variance) for longer m instead. Its 95 % intervals hold in only 78 % of logs of
/// white noise at a third of the log; here they hold in 98 % (docs/performance.md).
///
/// Of more than 2¹⁶ averages only the first 2¹⁶ are read: the standard error of the slope is then below 0.02.
template <typename Scalar>
[[nodiscard]] int noise_type(const IntegratedSignal<Scalar>& signal, std::int64_t m) {
  const std::int64_t longest = signal.samples() / detail::fewest_averages;
  if (longest < 1) return 0;
  if (m > longest) return (std::min)(noise_type(signal, longest), 0);
  const std::int64_t count = (std::min)(signal.samples() / m, detail::most_averages);
  std::vector<Scalar> z(static_cast<std::size_t>(count));
  const auto& x = signal.sums();
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto begin = i * static_cast<std::size_t>(m);
    z[i] = x[begin + static_cast<std::size_t>(m)] - x[begin];
  }
  for (int d = 0;; ++d) {
    Scalar mean = 0;
    for (const Scalar& value : z) mean += value;
    const auto n = static_cast<Scalar>(z.size());
    mean /= n;
    Scalar lag0 = 0, lag1 = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      lag0 += (z[i] - mean) * (z[i] - mean);
      if (i > 0) lag1 += (z[i] - mean) * (z[i - 1] - mean);
    }
    if (const auto alpha = detail::power_law(lag0, lag1, n, d)) return *alpha;
    for (std::size_t i = 0; i + 1 < z.size(); ++i) z[i] = z[i + 1] - z[i];
    z.pop_back();
  }
}

}  // namespace splinertia::allan
