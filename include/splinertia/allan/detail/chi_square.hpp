// SPDX-License-Identifier: MIT
/// The chi-square distribution with real degrees of freedom, as far as the analysis needs it: its quantile, its upper
/// tail, and the confidence interval of a deviation. gamma_tails.hpp has the accuracy. float is computed in double.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <splinertia/allan/detail/gamma_tails.hpp>
#include <splinertia/allan/interval.hpp>
#include <splinertia/detail/require.hpp>
#include <type_traits>

namespace splinertia::allan::detail {

/// The probability that a normal number is within one standard deviation of its mean: erf(1/√2) = 68.27 %.
template <std::floating_point Scalar>
inline constexpr Scalar one_sigma = static_cast<Scalar>(0.682689492137085897170465091264075845L);

/// The probability that a normal number is within two standard deviations of its mean: erf(√2) = 95.45 %.
template <std::floating_point Scalar>
inline constexpr Scalar two_sigma = static_cast<Scalar>(0.954499736103641585599434725666933125L);

/// The type of the computation: double for float, otherwise the type itself.
template <std::floating_point Scalar>
using AtLeastDouble = std::conditional_t<std::same_as<Scalar, float>, decltype(1.0), Scalar>;

/// P(X > x) for a chi-square X with these degrees of freedom > 0, x >= 0, with a small relative error.
/// From here on, each function throws std::invalid_argument for arguments that are not finite or out of range.
template <std::floating_point Scalar>
[[nodiscard]] Scalar chi_square_upper_tail(Scalar x, Scalar degrees_of_freedom) {
  splinertia::detail::require_non_negative("chi_square_upper_tail", "x", x);
  splinertia::detail::require_positive("chi_square_upper_tail", "degrees of freedom", degrees_of_freedom);
  using Wide = AtLeastDouble<Scalar>;
  return static_cast<Scalar>(gamma_tails(Wide(degrees_of_freedom) / 2, Wide(x) / 2).upper);
}

template <std::floating_point Scalar>
void require_probability(const char* whose, const char* parameter, Scalar value) {
  splinertia::detail::require(value > Scalar(0) && value < Scalar(1), whose, parameter, value,
                              "a number between 0 and 1");
}

/// The x with P(X <= x) = probability, 0 < probability < 1.
template <std::floating_point Scalar>
[[nodiscard]] Scalar chi_square_quantile(Scalar probability, Scalar degrees_of_freedom) {
  require_probability("chi_square_quantile", "probability", probability);
  splinertia::detail::require_positive("chi_square_quantile", "degrees of freedom", degrees_of_freedom);
  using Wide = AtLeastDouble<Scalar>;
  const bool upper = probability > Scalar(1) / 2;  // from there on 1 − probability is exact
  const Wide tail = upper ? Wide(1) - Wide(probability) : Wide(probability);
  return static_cast<Scalar>(2 * gamma_quantile(Wide(degrees_of_freedom) / 2, tail, upper));
}

/// The two-sided confidence interval of σ from an estimate s = `deviation` >= 0 in any unit whose square is distributed
/// as σ² χ²(edf)/edf: [s √(edf/q((1 + c)/2)), s √(edf/q((1 − c)/2))], q the quantile, c the confidence in (0, 1). With
/// few degrees of freedom (below 1) s itself can be outside. The upper end is infinite only if it overflows.
template <std::floating_point Scalar>
[[nodiscard]] Interval<Scalar> deviation_interval(Scalar deviation, Scalar degrees_of_freedom,
                                                  Scalar confidence = one_sigma<Scalar>) {
  splinertia::detail::require_non_negative("deviation_interval", "deviation", deviation);
  splinertia::detail::require_positive("deviation_interval", "degrees of freedom", degrees_of_freedom);
  require_probability("deviation_interval", "confidence", confidence);
  if (deviation == Scalar(0)) return {Scalar(0), Scalar(0)};
  using Wide = AtLeastDouble<Scalar>;
  const Wide a = Wide(degrees_of_freedom) / 2, tail = (Wide(1) - Wide(confidence)) / 2, s = Wide(deviation);
  const auto bound = [&](bool upper_tail) {
    const Wide quotient = gamma_quantile(a, tail, upper_tail) / a;
    if (quotient >= (std::numeric_limits<Wide>::min)()) return s / std::sqrt(quotient);
    // As in gamma_quantile, where the quantile underflows and its root does not. There a is below 1.
    return std::exp(std::log(s) - ((std::log(tail) + std::log(std::tgamma(a + 1))) / a - std::log(a)) / 2);
  };
  const auto narrow = [](Wide x) {
    return x > Wide((std::numeric_limits<Scalar>::max)()) ? std::numeric_limits<Scalar>::infinity()
                                                          : static_cast<Scalar>(x);
  };
  return {narrow(bound(true)), narrow(bound(false))};
}

}  // namespace splinertia::allan::detail
