// SPDX-License-Identifier: MIT
/// The deviations of Riley, "Handbook of Frequency Stability Analysis", NIST Special Publication 1065 (2008). Each is a
/// type with its number of terms and the divisor of its mean square. The handbook's frequency is the rate signal here,
/// its phase the integral of the rate.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <splinertia/allan/averaging_factors.hpp>
#include <splinertia/allan/detail/difference_sums.hpp>
#include <splinertia/allan/integrated_signal.hpp>
#include <string_view>
#include <vector>

namespace splinertia::allan {

/// ADEV: differences of neighbouring averages over tau that share no samples.
struct AllanDeviation {
  static constexpr std::string_view name = "adev";
  static constexpr int differences = 2;  ///< order of the difference of the running sums
  static constexpr bool overlapping = false, modified = false;
  static constexpr int divisor = 2;  ///< variance = Σ(…)²/(divisor·m²·terms)
  [[nodiscard]] static std::int64_t terms(std::int64_t n, std::int64_t m) { return n / m - 1; }
  [[nodiscard]] static std::int64_t largest_factor(std::int64_t n) { return n / 2; }
};

/// Overlapping ADEV: the differences of ADEV, one at every sample. The estimator of choice: it uses all that the log
/// says about tau.
struct OverlappingAllanDeviation : AllanDeviation {
  static constexpr std::string_view name = "oadev";
  static constexpr bool overlapping = true;
  [[nodiscard]] static std::int64_t terms(std::int64_t n, std::int64_t m) { return n + 1 - 2 * m; }
};

/// MDEV: the differences are averaged over tau as well, which separates white from flicker noise of the integral (Q).
struct ModifiedAllanDeviation : AllanDeviation {
  static constexpr std::string_view name = "mdev";
  static constexpr bool overlapping = true, modified = true;
  [[nodiscard]] static std::int64_t terms(std::int64_t n, std::int64_t m) { return n + 2 - 3 * m; }
  [[nodiscard]] static std::int64_t largest_factor(std::int64_t n) { return (n + 1) / 3; }
};

/// TDEV = tau/√3·MDEV: a deviation of the integral, in its unit.
struct TimeDeviation : ModifiedAllanDeviation {
  static constexpr std::string_view name = "tdev";
};

/// HDEV: second differences of averages that share no samples, insensitive to a constant drift of the rate.
struct HadamardDeviation {
  static constexpr std::string_view name = "hdev";
  static constexpr int differences = 3;
  static constexpr bool overlapping = false, modified = false;
  static constexpr int divisor = 6;
  [[nodiscard]] static std::int64_t terms(std::int64_t n, std::int64_t m) { return n / m - 2; }
  [[nodiscard]] static std::int64_t largest_factor(std::int64_t n) { return n / 3; }
};

/// Overlapping HDEV.
struct OverlappingHadamardDeviation : HadamardDeviation {
  static constexpr std::string_view name = "ohdev";
  static constexpr bool overlapping = true;
  [[nodiscard]] static std::int64_t terms(std::int64_t n, std::int64_t m) { return n + 1 - 3 * m; }
};

/// TOTDEV: ADEV of the running sums, extended at both ends by reflection, which reduces its scatter at long tau. For
/// flicker noise and random walk it is too small by a share of 0.24·tau/duration and 0.375·tau/duration (SP 1065). This
/// bias is not corrected here.
struct TotalDeviation : OverlappingAllanDeviation {
  static constexpr std::string_view name = "totdev";
  [[nodiscard]] static std::int64_t terms(std::int64_t n, std::int64_t) { return n - 1; }
};

template <typename D>
concept Deviation = requires(std::int64_t n, std::int64_t m) {
  { D::terms(n, m) } -> std::same_as<std::int64_t>;
  { D::largest_factor(n) } -> std::same_as<std::int64_t>;
  { D::name } -> std::convertible_to<std::string_view>;
};

/// The deviation at each of `factors` (ascending, 1 to D::largest_factor), in the signal's unit; TDEV in that of the
/// integral. Needs memory for the result only; time is proportional to samples × factors. Throws std::invalid_argument
/// for a factor that is outside the data.
template <Deviation D, typename Scalar>
[[nodiscard]] std::vector<Scalar> deviations(const IntegratedSignal<Scalar>& signal,
                                             const std::vector<std::int64_t>& factors) {
  (void)AveragingFactors::given(factors).up_to(D::largest_factor(signal.samples()));
  const std::vector<Scalar>& x = signal.sums();
  std::vector<Scalar> result;
  if constexpr (D::overlapping && !D::modified) {
    result = detail::overlapping_difference_sums<D::differences>(x, factors);
  }
  for (std::size_t j = 0; j < factors.size(); ++j) {
    const auto m = static_cast<Scalar>(factors[j]);
    if constexpr (D::modified) {
      result.push_back(detail::modified_difference_sum(x, factors[j]) / (m * m));
    } else if constexpr (!D::overlapping) {
      result.push_back(detail::separate_difference_sum<D::differences>(x, factors[j]));
    } else if constexpr (std::same_as<D, TotalDeviation>) {
      result[j] += detail::reflected_difference_sum(x, factors[j]);
    }
    const auto terms = static_cast<Scalar>(D::terms(signal.samples(), factors[j]));
    result[j] = std::sqrt(result[j] / (Scalar(D::divisor) * terms)) / m * signal.unit();
    if constexpr (std::same_as<D, TimeDeviation>) result[j] *= m / (signal.rate() * std::sqrt(Scalar(3)));
  }
  return result;
}

}  // namespace splinertia::allan
