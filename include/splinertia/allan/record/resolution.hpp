// SPDX-License-Identifier: MIT
/// The resolution of a signal, and what rounding does to its noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/detail/require.hpp>
#include <vector>

namespace splinertia::allan {

/// The resolution of a signal (least significant bit, LSB) in its unit: the spacing of the values it takes.
///
/// At least 16384 samples, spread over the signal, are read (all of a shorter one). The spacing is the lower quartile
/// of the distances between neighbouring values, refined over all of them. 95 % of the distances must be multiples of
/// it to within a quarter (all but one or two of fewer than 40). That tolerates text rounded to a fifth of the
/// resolution, and a stray value. Returns nothing if values hardly ever repeat (a resolution below about 1/1000 of the
/// spread, which does not matter), if they are not equally spaced, and for a constant signal.
template <Signal S>
[[nodiscard]] std::optional<double> find_resolution(const S& signal) {
  constexpr std::int64_t most = 16384;
  const auto size = static_cast<std::int64_t>(std::distance(std::begin(signal), std::end(signal)));
  const std::int64_t stride = std::max<std::int64_t>(1, size / most);
  std::vector<double> values;
  auto value = std::begin(signal);
  for (std::int64_t i = 0; i < size; ++i, ++value) {
    if (i % stride == 0) values.push_back(static_cast<double>(*value));
  }
  const std::size_t samples = values.size();
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 2 || 10 * values.size() > 9 * samples) return std::nullopt;
  std::vector<double> distances;
  for (std::size_t i = 1; i < values.size(); ++i) distances.push_back(values[i] - values[i - 1]);
  std::sort(distances.begin(), distances.end());
  double resolution = distances[distances.size() / 4];
  const auto fits = [&](double distance) {
    const double multiple = distance / resolution;
    return multiple > 0.5 && std::abs(multiple - std::round(multiple)) < 0.25;
  };
  double total = resolution, steps = 1;
  for (const double distance : distances) {
    if (!fits(distance)) continue;
    total += distance;
    steps += std::round(distance / resolution);
    resolution = total / steps;
  }
  const auto count = static_cast<std::int64_t>(distances.size());
  const std::int64_t misfits = count - std::count_if(distances.begin(), distances.end(), fits);
  if (misfits > (std::max)(count / 20, std::min<std::int64_t>(2, count / 5))) return std::nullopt;
  return resolution;
}

/// What rounding does to an estimate of white noise.
enum class RoundingEffect {
  none,    ///< N is less than 1 % too large
  slight,  ///< N is up to 17 % too large; white_noise_before_rounding() corrects that to within 2 %
  invalid  ///< N says nothing of the sensor: it may be too small by any factor, or too large by LSB/2σ
};

/// The effect, from the resolution and the standard deviation of a sample measured after rounding (N √rate), in the
/// same unit. As long as LSB < 2σ, with σ the standard deviation before rounding, rounding adds a white, independent
/// error of standard deviation LSB/√12 (Widrow, Kollár, "Quantization Noise", 2008, chapter 5). Above, everything
/// depends on where the mean is between two values. Standard deviation after rounding over that before, with the mean
/// on a value and half-way between two:
///
///   LSB/σ           0.3     0.5     1       1.5     2       2.5     3       4       6
///   on a value      1.004   1.010   1.041   1.089   1.141   1.151   1.097   0.853   0.312
///   half-way        1.004   1.010   1.041   1.090   1.168   1.311   1.516   2.000   3.000
///
/// `none` up to LSB = 0.5 σ, `slight` up to LSB = 2 σ, which are 0.495 and 1.73 times the measured deviation.
/// Throws std::invalid_argument for a resolution or deviation that is not finite and >= 0.
[[nodiscard]] inline RoundingEffect rounding_effect(double resolution, double deviation) {
  splinertia::detail::require_non_negative("rounding_effect", "resolution", resolution);
  splinertia::detail::require_non_negative("rounding_effect", "deviation", deviation);
  if (resolution <= 0.495 * deviation) return RoundingEffect::none;
  return resolution <= 1.73 * deviation ? RoundingEffect::slight : RoundingEffect::invalid;
}

/// White noise N [unit/√Hz] without what rounding adds: √(N² − LSB²/(12 rate)), rate in Hz. Right to within 2 % for
/// RoundingEffect::none and slight; 0 if rounding alone explains more than N.
/// Throws std::invalid_argument for a rate that is not > 0, and for N and a resolution that are not >= 0.
[[nodiscard]] inline double white_noise_before_rounding(double N, double resolution, double rate) {
  splinertia::detail::require_non_negative("white_noise_before_rounding", "N", N);
  splinertia::detail::require_non_negative("white_noise_before_rounding", "resolution", resolution);
  splinertia::detail::require_positive("white_noise_before_rounding", "rate", rate);
  return std::sqrt((std::max)(0.0, N * N - resolution * resolution / (12 * rate)));
}

}  // namespace splinertia::allan
