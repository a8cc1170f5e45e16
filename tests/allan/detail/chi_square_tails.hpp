// SPDX-License-Identifier: MIT
/// The lower tail of the chi-square distribution and the inverse of its upper tail, for tests.
#pragma once

#include <splinertia/allan/detail/chi_square.hpp>

namespace splinertia::allan {

using namespace splinertia::detail;

using namespace detail;

/// P(X <= x), x >= 0.
template <std::floating_point Scalar>
[[nodiscard]] Scalar chi_square_cdf(Scalar x, Scalar degrees_of_freedom) {
  using Wide = AtLeastDouble<Scalar>;
  return static_cast<Scalar>(gamma_tails(Wide(degrees_of_freedom) / 2, Wide(x) / 2).lower);
}

/// The x with P(X > x) = probability, also for probabilities so small that 1 − probability would be rounded.
template <std::floating_point Scalar>
[[nodiscard]] Scalar chi_square_upper_quantile(Scalar probability, Scalar degrees_of_freedom) {
  using Wide = AtLeastDouble<Scalar>;
  const bool upper = probability <= Scalar(1) / 2;
  const Wide tail = upper ? Wide(probability) : Wide(1) - Wide(probability);
  return static_cast<Scalar>(2 * gamma_quantile(Wide(degrees_of_freedom) / 2, tail, upper));
}

}  // namespace splinertia::allan
