// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <splinertia/camera/detail/bisect.hpp>
#include <splinertia/detail/finite.hpp>

namespace splinertia::detail {

/// The x in [low, high] with f(x) = y, for f that increases there and is right at both ends: f(low) ≤ y ≤ f(high).
/// evaluate(x, slope) returns f(x) and sets its derivative. Newton's method; a step that leaves the interval that is
/// left, or does not halve often enough, is replaced by a bisection, or by doubling x where `high` is far away. It ends
/// where the step or the residual is of the size of rounding. docs/cameras.md has the number of steps.
template <typename Scalar>
[[nodiscard]] Scalar increasing_inverse(const auto& evaluate, const Scalar& y, Scalar low, Scalar high, Scalar start) {
  constexpr auto epsilon = std::numeric_limits<Scalar>::epsilon;
  Scalar x = start;
  Scalar last_step = high - low;
  for (int i = 0; i < 40000; ++i) {  // bisection of any interval ends before
    Scalar slope;
    const Scalar excess = evaluate(x, slope) - y;
    // The last step gives the derivatives of a Jet.
    if (excess == Scalar(0)) return slope > Scalar(0) ? Scalar(x - excess / slope) : x;
    (excess < Scalar(0) ? low : high) = x;  // NaN: f overflows
    Scalar next = x - excess / slope;
    const Scalar size = x > Scalar(0) ? x : Scalar(-x), step = next > x ? next - x : x - next;
    if (step <= epsilon() / Scalar(2) * size && is_finite(slope)) return next;
    const bool inside = low < next && next < high;
    const bool slow = step > last_step / Scalar(2);
    const Scalar left = excess > Scalar(0) ? excess : Scalar(-excess);
    if ((slow || !inside) && left <= Scalar(16) * epsilon() * (y > Scalar(0) ? y : Scalar(-y))) {  // rounding
      return inside || !std::floating_point<Scalar> ? next : x;
    }
    if (!inside || (i > 3 && slow)) {
      next = Scalar(0) < low && low < high / Scalar(8) ? low + low : middle_of(low, high);
      if (!(low < next && next < high)) return x;  // neighbouring numbers
    }
    last_step = next > x ? next - x : x - next;
    x = next;
  }
  return x;
}

}  // namespace splinertia::detail
